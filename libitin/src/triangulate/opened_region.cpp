#include "triangulate/opened_region.hpp"

#include <itin/sort_unique.hpp>

namespace itin {

namespace {

GridBox box_about(const std::array<Position, 3>& corners) {
  GridBox box;
  for (const Position& p : corners) box.extend(p.x, p.y);
  return box;
}

Position twice(const Position& p) {
  return {2 * p.x, 2 * p.y};
}

}  // namespace

bool cross(const PlanEdge& e, const PlanEdge& f) {
  return orientation(e.first, e.second, f.first) * orientation(e.first, e.second, f.second) < 0 &&
         orientation(f.first, f.second, e.first) * orientation(f.first, f.second, e.second) < 0;
}

void OpenedRegion::finish(std::vector<SidedEdge> edges) {
  sort_unique(lowered_);
  sort_unique(removed_);
  std::erase_if(removed_, [&](std::uint64_t code) { return has_code(lowered_, code); });
  // An edge of one triangle is on the border. Between two it stays where it is on the ground.
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool shared = i + 1 < edges.size() && edges[i + 1] == edges[i];
    if (!shared || edges[i].on_ground) borders_.push_back(edges[i].edge);
    if (shared) ++i;
  }
  std::erase_if(borders_, [&](const PlanEdge& e) {
    return has_code(removed_, code_of(e.first)) || has_code(removed_, code_of(e.second));
  });
  sort_unique(borders_);
  sort_unique(feet_);
  std::erase_if(feet_, [&](std::uint64_t code) { return has_code(removed_, code); });
  triangles_near_ = BoxIndex(boxes_of_triangles());
  std::vector<GridBox> boxes;
  for (const PlanEdge& e : borders_) boxes.push_back(extent_of(e));
  borders_near_ = BoxIndex(std::move(boxes));
}

std::vector<GridBox> OpenedRegion::boxes_of_triangles() const {
  std::vector<GridBox> boxes;
  for (const Corners& corners : triangles_) boxes.push_back(box_about(corners));
  return boxes;
}

OpenedRegion::Side OpenedRegion::side_of_middle(const Position& a, const Position& b) const {
  // Everything is doubled, so that the middle is on the grid.
  const Position middle{a.x + b.x, a.y + b.y};
  const GridBox about{(middle.x - 1) >> 1, (middle.y - 1) >> 1, (middle.x + 1) >> 1, (middle.y + 1) >> 1};
  bool covered = false, on_border = false;
  triangles_near_.for_each(about, [&](std::uint32_t i) {
    const auto& [p, q, r] = triangles_[i];
    covered = covered || (orientation(twice(p), twice(q), middle) >= 0 &&
                          orientation(twice(q), twice(r), middle) >= 0 && orientation(twice(r), twice(p), middle) >= 0);
  });
  if (!covered) return Side::outside;
  for_each_border(about, [&](const PlanEdge& e) {
    const PlanEdge doubled{twice(e.first), twice(e.second)};
    on_border = on_border || (extent_of(doubled).contains(middle.x, middle.y) &&
                              orientation(doubled.first, doubled.second, middle) == 0);
  });
  return on_border ? Side::border : Side::inside;
}

}  // namespace itin
