#include <cmath>

#include <viewshed/missing_ground.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

MissingGround missing_ground(const VisibilityIndex& index) {
  MissingGround missing;
  missing.with_ground = static_cast<std::uint64_t>(std::llround(index.ground * static_cast<double>(index.targets)));
  missing.without_ground = index.targets - missing.with_ground;
  return missing;
}

}  // namespace itin::viewshed
