// What an eye sees of turbines, one by one.
#pragma once

#include <vector>

#include <itin/cross_section.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns the sight of each turbine. Both ends of a line keep their bare ground whatever the surface.
std::vector<TurbineSight> sights_to_all(const SectionSurface& surface, const Viewpoint& from, const Zone& zone);

/// A turbine on its ground and an eye, elevations in metres.
struct TurbineFromEye {
  const Earth& earth;
  double ground_m = 0, tip_height = 0, eye_m = 0;
};

/// Adds the angles to a sight whose distance and tip are told: that of the tip, and where the tip is visible, what is
/// seen from `least` metres above the turbine's ground up.
void tell_angles(const TurbineFromEye& turbine, double least, TurbineSight& sight);

}  // namespace itin::viewshed
