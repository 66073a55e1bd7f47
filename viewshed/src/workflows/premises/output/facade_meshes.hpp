// Facades in the colours of what serves them, standing on the ground.
#pragma once

#include <vector>

#include <itin/mesh_export.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// Returns a mesh for each mast and class of walls that it serves best, and one for each class that none serves. Walls
/// face outward.
std::vector<ColouredMesh> facade_meshes(const PremisesSurvey& survey);

}  // namespace itin::viewshed
