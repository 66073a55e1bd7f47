#include "workflows/premises/output/facade_meshes.hpp"

#include <map>
#include <utility>

#include <itin/same_place.hpp>

#include "workflows/premises/output/wall_service.hpp"

namespace itin::viewshed {

namespace {

/// Adds the upright faces between the foot of a wall, which it looks to the left of, and its top.
void add_faces(const WallPlace& wall, const Grid& grid, ColouredMesh& mesh) {
  const auto top = [&](Point3 p) { return p.z = wall.ground_m + wall.most_m, p; };
  for (std::size_t i = 1; i < wall.stretch.size(); ++i) {
    const Point3 &a = wall.stretch[i - 1], &b = wall.stretch[i];
    if (same_place(grid, {a.x, a.y}, {b.x, b.y})) continue;
    mesh.triangles.push_back({b, a, top(a)});
    mesh.triangles.push_back({b, top(a), top(b)});
  }
}

}  // namespace

std::vector<ColouredMesh> facade_meshes(const PremisesSurvey& survey) {
  std::map<std::pair<std::size_t, WallService>, ColouredMesh> meshes;
  for (const Premises& p : survey.premises) {
    for (const WallPlace& wall : p.walls) {
      const WallService service = service_of(wall, survey.request.storey);
      ColouredMesh& mesh = meshes[{wall.mast.value_or(survey.masts.size()), service}];
      const FeatureClass& looks = class_of(service);
      mesh.name = wall.mast ? survey.masts[*wall.mast].name + ": " + looks.name : looks.name;
      mesh.colour = looks.colour;
      add_faces(wall, survey.metadata.grid, mesh);
    }
  }
  std::vector<ColouredMesh> facades;
  for (auto& [key, mesh] : meshes) facades.push_back(std::move(mesh));
  return facades;
}

}  // namespace itin::viewshed
