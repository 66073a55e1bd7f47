// How far from some eyes the ground may still hide the sun.
//
//   const SunReach reach = sun_reach(store, themes, earth, {eyes, lowest_eye, 3}, progress);
#pragma once

#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin::viewshed {

struct EyesInSun {
  Box box;                         ///< about all of them
  double lowest_m = 0;             ///< the lowest one's elevation
  double least_elevation_deg = 3;  ///< no lower sun counts
};

struct SunReach {
  double metres = 0;  ///< what is farther from the box hides no sun
  double top_m = 0;   ///< no surface within is higher
};

/// Looks at the coarsest level of the whole store, and its certificate. Throws as triangulate() does.
SunReach sun_reach(const Store& store, const ThemeChoice& themes, const Earth& earth, const EyesInSun& eyes,
                   Progress& progress);

}  // namespace itin::viewshed
