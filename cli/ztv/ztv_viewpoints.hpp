// The viewpoints of `itin ztv`: what is seen of every turbine from each, as tables, and wirelines.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "options/in_crs.hpp"
#include "options/sheet_options.hpp"
#include "program/verb.hpp"
#include "ztv/ztv_sheets.hpp"
#include "ztv/ztv_turbines.hpp"
#include "ztv/ztv_wirelines.hpp"

namespace itin::cli {

class ViewpointOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate(const InCrs& in_crs, const SheetOptions& sheets);
  bool given() const { return !query_.path.empty(); }
  bool draws_wirelines() const { return given() && !no_wirelines_; }
  Document parameters() const;

  struct Written {
    std::vector<viewshed::ZoneFile> files;
    std::size_t rows = 0;
    std::vector<BadRow> bad;
    std::string path;
    std::vector<std::string> warnings;  ///< about the file
    std::vector<NamedPlace> places;     ///< one for each viewpoint used
  };
  /// Writes viewpoints.csv, viewpoints-summary.csv, and the files of WirelineWriter for the viewpoints chosen. Throws
  /// FileError, InputError (a wireline of no viewpoint), Cancelled.
  Written write(const std::string& folder, const Store& store, const viewshed::Zone& zone, const SheetOptions& sheets,
                Progress& progress) const;

 private:
  void require_farm_known(const viewshed::Zone& zone) const;
  void require_wirelines_known(const std::vector<NamedPlace>& places) const;
  bool has_wireline(const Viewpoint& v) const;

  SiteQuery query_;
  std::string field_text_, bearing_text_, blades_text_, wirelines_text_;
  std::vector<std::string> wirelines_;  ///< names; empty: all
  bool no_wirelines_ = false;
  WirelineChoice choice_;
};

}  // namespace itin::cli
