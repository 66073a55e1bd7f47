// Fields of a file of observers that say what each observer looks at: named one by one, or as ArcGIS names them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <viewshed/request.hpp>

namespace itin::cli {

class ViewFields {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return !fields_.empty() || !text_given().empty(); }
  bool arcgis() const { return arcgis_; }
  bool reads_radii() const { return arcgis_ || !radius_.empty(); }
  bool reads_target_heights() const { return !target_height_.empty(); }
  /// The fields to read, in the order in which fill() takes them.
  std::vector<NumberField> numbers() const;
  /// Gives the observer the values of its fields; where they are empty it keeps its own. Throws InputError for a value
  /// out of range, which names `where`, the field and the value.
  void fill(viewshed::Observer& observer, const std::vector<std::optional<double>>& numbers,
            const std::string& where) const;
  /// Throws InputError, as fill() does, where the fields' values and the request for all observers exclude each other.
  void require_agreement(const viewshed::Observer& observer, const viewshed::Request& request,
                         const std::string& where) const;

 private:
  enum class Role {
    kHeight,
    kSpot,
    kTargetHeight,
    kRadius,
    kMinRadius,
    kAzimuthFrom,
    kAzimuthTo,
    kElevationFrom,
    kElevationTo
  };
  struct Field {
    Role role;
    std::string name;
  };

  std::string text_given() const;
  /// Returns "field 'reach'", or the option where the value is not the observer's own.
  std::string source_of(Role role, bool is_own, const char* option) const;
  void add_pair(const char* option, const std::string& text, Role from, Role to);

  bool arcgis_ = false;
  std::string target_height_, radius_, min_radius_, azimuths_, elevations_;
  std::vector<Field> fields_;
};

}  // namespace itin::cli
