// Radio links and radars beside a wind farm: `--links`, `--frequency`, `--radar`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "options/in_crs.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_turbines.hpp"

namespace itin::cli {

class ZtvRadioOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate();
  Document parameters() const;
  /// Reads the links. Throws FileError, InputError.
  void load(const InCrs& in_crs, const StoreMetadata& metadata);
  std::optional<viewshed::Observer> radar() const { return radar_; }
  const std::vector<viewshed::RadioLink>& links() const { return links_; }

  /// Writes the rasters of links and of the radar. Throws FileError.
  std::vector<viewshed::ZoneFile> write(const std::string& folder, const viewshed::Zone& zone,
                                        const viewshed::ZoneFileOptions& options) const;
  /// Return columns for the table of turbines: names with commas before them, and the values of turbine k of the
  /// request.
  std::string columns() const;
  std::string cells(const viewshed::Zone& zone, std::size_t k) const;
  /// Returns how many turbines are concerned; empty where neither links nor a radar were given.
  Document document(const viewshed::Zone& zone) const;
  /// Returns paragraphs for the methods text.
  std::vector<std::string> methods(const viewshed::Zone& zone) const;
  std::vector<std::string> warnings(const viewshed::Zone& zone) const;

 private:
  struct Nearest {
    std::string link;
    double clearance = 0;
  };
  /// Returns the link that is least clear of the turbine's own rotor.
  Nearest nearest_link(const viewshed::Turbine& turbine) const;
  viewshed::LinkStudy study(const viewshed::Zone& zone) const;

  std::string links_path_, frequency_text_, radar_text_;
  double frequency_ghz_ = 0;
  std::optional<Place> radar_place_;
  std::optional<viewshed::Observer> radar_;
  std::vector<viewshed::RadioLink> links_;
  std::vector<BadRow> bad_links_;
  std::vector<std::string> file_warnings_;  ///< about the links' file
};

}  // namespace itin::cli
