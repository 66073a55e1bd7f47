// What results of siting are called: of sites that serve, and of turbines that are seen.
#pragma once

#include <string>

#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns "the tip" or "the hub", whichever of a turbine is looked for.
const char* minimised_part(const TurbinePlacement& placement);

struct SiteWording {
  std::string one, mark;         ///< what a chosen one is called; `mark` with a capital
  std::string served, unserved;  ///< kinds of places on maps, with capitals
  std::string by;                ///< heads the map, before how many are chosen
  std::string how_many;          ///< heads the map of counts
  std::string count, nearest;    ///< describe bands of rasters
  std::string coverage_curve;    ///< a heading
  std::string order, count_heading;
  std::string bound;       ///< "no choice serves more than"
  std::string sufficient;  ///< why a first look was enough for some
};

SiteWording wording_of(const SitePlanRequest& request);

/// Returns "served", "too few", "undecided", "zone cut", "hidden", "out of reach" or "no ground".
const char* name_of(PointService service);

}  // namespace itin::viewshed
