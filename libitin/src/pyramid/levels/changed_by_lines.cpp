#include "pyramid/levels/changed_by_lines.hpp"

#include <algorithm>
#include <array>

#include <itin/box_of.hpp>

#include "triangulate/mesh/circumdisc.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

/// How far changes mostly reach beyond lines, as a share of the box about lines near each other.
constexpr double kMargin = 0.1;

/// The box of the mesh's triangles that meet `line`, and of the triangles with circumdiscs that reach `line` that are
/// joined to these by edges of no line.
GridBox joined_to(const RegionMesh& about, const GridBox& line) {
  const PlaneMesh& mesh = about.mesh;
  const auto corner = [&](std::uint32_t t, int i) { return about.vertices[mesh.triangles[t][i]].position(); };
  std::vector<bool> seen(mesh.triangles.size());
  std::vector<std::uint32_t> joined;
  const auto add = [&](std::uint32_t t) {
    if (t == kNoTriangle || seen[t]) return;
    seen[t] = true;
    if (circumdisc_reaches(corner(t, 0), corner(t, 1), corner(t, 2), line)) joined.push_back(t);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const GridBox box = box_of(std::array{corner(t, 0), corner(t, 1), corner(t, 2)});
    if (box.meets(line)) add(t);
  }
  GridBox result = line;
  while (!joined.empty()) {
    const std::uint32_t t = joined.back();
    joined.pop_back();
    for (int i = 0; i < 3; ++i) {
      result.extend(corner(t, i).x, corner(t, i).y);
      if (!(mesh.constrained[t] >> i & 1)) add(mesh.neighbours[t][i]);
    }
  }
  return result;
}

GridBox changed_by_line(const PointIndex& index, const Selection& selection, const GridBox& line) {
  // Triangles that lack neighbours in the mesh may leave the box, which then was too small.
  for (GridBox box = line;;) {
    const GridBox joined = joined_to(triangulate_region(index, selection, box), line);
    if (box.contains(joined)) return joined;
    box = joined;
  }
}

}  // namespace

std::vector<GridBox> changed_by_lines(const PointIndex& index, const Selection& selection,
                                      const std::vector<GridBox>& lines) {
  GridBox box;
  for (const GridBox& line : lines) box.extend(line);
  box = expanded(box, kMargin * std::max(box.xmax - box.xmin, box.ymax - box.ymin));
  const RegionMesh about = triangulate_region(index, selection, box);
  std::vector<GridBox> changed;
  for (const GridBox& line : lines) {
    const GridBox joined = joined_to(about, line);
    changed.push_back(box.contains(joined) ? joined : changed_by_line(index, selection, line));
  }
  return changed;
}

}  // namespace itin
