// Maps of a choice of sites: of what is served, and of how many sites serve a place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

struct SiteMap {
  std::string name;  ///< its raster's, without the ending
  Result result;     ///< the choice in the form of a viewshed, from which maps are drawn
  MapOptions options;
  MissingGround missing = {};
};

/// What is looked at, in texts about missing ground.
inline constexpr const char* kWithinRadius = "the area within the radius";

/// Returns the maps `coverage` and `redundancy`.
std::vector<SiteMap> site_maps(const Store& store, const SitePlan& plan, Progress& progress);

/// Returns the points of the demand by how they are served, a colour for each class that has any; none where masts do
/// not serve points. Of points of a class that would cover each other on a map of the plan the first is kept.
std::vector<MapDots> dots_of_points(const SitePlan& plan);

/// Draws the maps over a hillshade of the plan's ground.
std::vector<MapImage> drawn(const Store& store, const SitePlan& plan, const std::vector<SiteMap>& maps,
                            Progress& progress);

/// Returns about how many bytes the rasters of a choice on these cells, and the maps of them, take.
std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid);

}  // namespace itin::viewshed
