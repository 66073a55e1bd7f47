// The viewpoints of `itin ztv`: what is seen of every turbine from each, as a table, and a wireline for each.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "options/in_crs.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_sheets.hpp"
#include "ztv/ztv_turbines.hpp"

namespace itin::cli {

class ViewpointOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate(const InCrs& in_crs);
  bool given() const { return !query_.path.empty(); }
  Document parameters() const;

  struct Written {
    std::vector<viewshed::ZoneFile> files;
    std::size_t rows = 0;
    std::vector<BadRow> bad;
    std::string path;
    std::vector<NamedPlace> places;  ///< of the viewpoints used
  };
  /// viewpoints.csv, and wireline-NAME.svg, .pdf and .png for each viewpoint. Throws FileError, Cancelled.
  Written write(const std::string& folder, const Store& store, const viewshed::Zone& zone, Progress& progress) const;

 private:
  SiteQuery query_;
  std::string field_text_;
  double field_deg_ = 53.5;  ///< of a wireline at least
};

}  // namespace itin::cli
