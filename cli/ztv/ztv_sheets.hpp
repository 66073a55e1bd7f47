// The map sheets of `itin ztv`: every map of the zone on every paper asked for.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/paths.hpp>
#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_files.hpp>

#include "options/sheet_options.hpp"

namespace itin::cli {

struct NamedPlace {
  std::size_t number = 0;  ///< from 1
  std::string name;
  Point2 position;
};

/// Objects and facts that sheets show in addition to the zone.
struct ZtvSheetFacts {
  std::vector<NamedPlace> viewpoints;
  std::vector<Path> routes;
  std::vector<viewshed::RadioLink> links;
  std::optional<viewshed::Observer> radar;
  std::vector<SourceInfo> sources;  ///< within the study area
  viewshed::MissingGround missing;  ///< in the study area
};

/// Writes sheet-NAME-A3.pdf and .png of each map. Throws FileError, InputError (a scale that is too large), Cancelled.
std::vector<viewshed::ZoneFile> write_ztv_sheets(const std::string& folder, const Store& store,
                                                 const viewshed::Zone& zone, const viewshed::SheetChoice& choice,
                                                 const ZtvSheetFacts& facts, Progress& progress);

}  // namespace itin::cli
