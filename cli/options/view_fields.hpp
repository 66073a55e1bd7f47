// Fields of a file of observers that say what each of them looks at: named one by one, or as ArcGIS names them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class ViewFields {
 public:
  using Angles = std::pair<double, double>;  ///< degrees, from and to

  /// The values of an observer's fields; nothing where they are empty.
  struct View {
    std::optional<double> height;  ///< OFFSETA
    std::optional<double> spot;    ///< SPOT: the elevation that the height is above
    std::optional<double> target_height;
    std::optional<double> radius;
    std::optional<double> min_radius;
    std::optional<Angles> azimuth;
    std::optional<Angles> elevation;
  };

  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return !fields_.empty() || !text_given().empty(); }
  bool arcgis() const { return arcgis_; }
  /// The fields to read, in the order that view() takes them.
  std::vector<NumberField> numbers() const;
  /// Throws InputError for a value out of range, saying `where`, the field and the value.
  View view(const std::vector<std::optional<double>>& numbers, const std::string& where) const;

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
  void add_pair(const char* option, const std::string& text, Role from, Role to);

  bool arcgis_ = false;
  std::string target_height_, radius_, min_radius_, azimuths_, elevations_;
  std::vector<Field> fields_;
};

/// Adds what the view says under the contract's names.
void add_view(const ViewFields::View& view, Document& observer);

}  // namespace itin::cli
