// The upper end of an observer.
#pragma once

#include <optional>
#include <string>

#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

struct Eye {
  Point2 position;
  double elevation = 0;  ///< metres
  Point3 units;          ///< the same in grid units
};

/// An observer on ground of this elevation. Throws InputError, naming the observer, where there is none, or where an
/// absolute height lies below it.
Eye eye_of(const Grid& grid, const Observer& observer, std::optional<double> ground);

[[noreturn]] void refuse(const Observer& observer, const std::string& why);

}  // namespace itin::viewshed
