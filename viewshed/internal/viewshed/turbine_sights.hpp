// What an eye sees of turbines, one by one.
#pragma once

#include <vector>

#include <itin/cross_section.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns the sight of each turbine. Both ends of a line keep their bare ground whatever the surface.
std::vector<TurbineSight> sights_to_all(const SectionSurface& surface, const Viewpoint& from, const Zone& zone);

}  // namespace itin::viewshed
