#include <viewshed/missing_ground.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

MissingGround missing_ground(const VisibilityIndex& index) {
  MissingGround missing;
  missing.with_ground = index.lines;
  missing.without_ground = index.targets - index.lines;
  return missing;
}

}  // namespace itin::viewshed
