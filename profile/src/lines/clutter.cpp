#include "lines/clutter.hpp"

#include <profile/diffraction.hpp>

namespace itin::profile {

Profile clutter_raised(const Profile& ground) {
  Profile raised = ground;
  for (ProfilePoint& p : raised.points) {
    const double top = clutter_top_m(ground, p);
    if (top > p.ground_m) p.theme = kClutterTheme;
    p.ground_m = top, p.clutter_m = 0;
  }
  return raised;
}

}  // namespace itin::profile
