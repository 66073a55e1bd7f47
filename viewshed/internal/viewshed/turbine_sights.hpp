// What an eye sees of turbines, one by one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

struct Viewpoint {
  std::size_t number = 0;
  std::string name;
  Point2 position;
  double height = 0;  ///< how high the eye is above the ground
  double ground = 0;
};

/// The part of one turbine that is seen from one viewpoint.
struct TurbineSight {
  using Verdict = viewshed::Verdict;  ///< kUndecided: ground without data alone leaves it open
  double distance = 0, azimuth = 0;
  Verdict tip = Verdict::kHidden;
  std::optional<Verdict> hub;            ///< nothing: the hub's height is not known
  double visible = 0, vertical_deg = 0;  ///< what is certainly seen: metres from the tip down, degrees
  double tip_deg = 0;
  bool gaps = false;
};

/// Returns the sight of each turbine. Both ends of a line keep their bare ground whatever the surface.
std::vector<TurbineSight> sights_to_all(const SectionSurface& surface, const Viewpoint& from, const Zone& zone);

}  // namespace itin::viewshed
