// The upper end of an observer, and what it looks at.
#pragma once

#include <optional>
#include <string>

#include <itin/same_place.hpp>
#include <viewshed/request.hpp>

#include "request/field_of_view.hpp"

namespace itin::viewshed {

struct Eye {
  Point2 position;
  double elevation = 0;   ///< metres
  Point3 units;           ///< the same in grid units
  bool absolute = false;  ///< the elevation was given, not a height above the ground
  FieldOfView view;
  double target_height = 0;  ///< metres above the ground, or an elevation when `target_absolute`
  bool target_absolute = false;

  /// Whether a place in grid units is the eye's own.
  bool stands_at(Point2 place) const { return same_place(place.x - units.x, place.y - units.y); }
  /// The offset from the eye to a place, metres; zero to its own place, which lies straight above or below.
  Point2 offset_to(Point2 metres, Point2 place) const {
    return stands_at(place) ? Point2{} : Point2{metres.x - position.x, metres.y - position.y};
  }

  /// The elevation of the target on ground of this elevation, metres.
  double target(double ground) const { return target_absolute ? target_height : ground + target_height; }
};

/// Returns the eye of an observer of the request on ground of this elevation. Throws InputError, naming the observer,
/// where there is no ground, or where an absolute height lies below it.
Eye eye_of(const Grid& grid, const Request& request, const Observer& observer, std::optional<double> ground);

[[noreturn]] void refuse(const Observer& observer, const std::string& why);

}  // namespace itin::viewshed
