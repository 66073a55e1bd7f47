// The foliage on a path that keeps to the ground.
#pragma once

#include <profile/foliage.hpp>
#include <profile/leaf_areas.hpp>

namespace itin::profile {

/// Returns what stands on the surface's path of the vegetation that has these leaf areas. Throws CorruptStore.
PathFoliage foliage_on_path(const Profile& surface, const LeafAreas& leaves);

}  // namespace itin::profile
