// Maps of a choice of sites: of what is served, and of how many sites serve a place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

struct SiteMap {
  std::string name;   ///< its raster's, without the ending
  std::string about;  ///< what sites were chosen for, in a phrase
  ResultSheet sheet;  ///< its title block ends with the fact of the Earth, and has no sources
};

/// Returns the names of the maps of a choice.
std::vector<std::string> site_map_names(const SitePlanRequest& request);

/// Returns the maps `coverage` and `redundancy`, and `level` where sites are chosen by levels. They are of one area,
/// and show the same objects. They refer to the plan.
std::vector<SiteMap> site_maps(const Store& store, const SitePlan& plan, Progress& progress);

/// Draws the maps over a hillshade of the plan's ground.
std::vector<MapImage> drawn(const Store& store, const SitePlan& plan, const std::vector<SiteMap>& maps,
                            Progress& progress);

/// Returns about how many bytes the rasters of a choice on these cells, and the maps of them, take.
std::uint64_t bytes_of_site_maps(const Store& store, const SitePlanRequest& request, const RasterGrid& grid);

}  // namespace itin::viewshed
