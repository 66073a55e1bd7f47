#include "pyramid/levels/whole_levels.hpp"

#include <algorithm>

#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/levels/cell_verification.hpp"
#include "triangulate/mesh/mesh_order.hpp"
#include "triangulate/mesh/triangle_box.hpp"

namespace itin {

namespace {

/// The most points of all levels that are held as a whole.
constexpr std::uint64_t kMostHeld = 1 << 20;
/// The squares of the grid along each side of the bounds.
constexpr std::int64_t kSquares = 64;

/// The number of each of some items, ascending, among them; kNoTriangle for others.
std::uint32_t number_among(const std::vector<std::uint32_t>& items, std::uint32_t item) {
  const auto at = std::lower_bound(items.begin(), items.end(), item);
  return at != items.end() && *at == item ? static_cast<std::uint32_t>(at - items.begin()) : kNoTriangle;
}

/// The mesh of these triangles, ascending, with the vertices that they use. In time, it follows them alone.
RegionMesh with_triangles(const RegionMesh& whole, const std::vector<std::uint32_t>& kept) {
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : kept)
    used.insert(used.end(), whole.mesh.triangles[t].begin(), whole.mesh.triangles[t].end());
  sort_unique(used);
  RegionMesh result;
  for (const std::uint32_t v : used) result.vertices.push_back(whole.vertices[v]);
  for (const std::uint32_t t : kept) {
    Triangle triangle{}, neighbours{};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = number_among(used, whole.mesh.triangles[t][i]);
      neighbours[i] = number_among(kept, whole.mesh.neighbours[t][i]);
    }
    result.mesh.triangles.push_back(triangle);
    result.mesh.neighbours.push_back(neighbours);
    result.mesh.constrained.push_back(whole.mesh.constrained[t]);
  }
  result.mesh = in_order(result.mesh, result.vertices.size());
  return result;
}

}  // namespace

WholeLevels::WholeLevels(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, unsigned levels)
    : bounds_(index.bounds()), levels_(tolerances.size()) {
  std::vector<int> held;
  std::uint64_t points = 0;
  for (int k = static_cast<int>(tolerances.size()) - 1; k >= 1; --k) {
    if (!(levels >> k & 1)) continue;
    points += index.selected_points(k);
    if (points > kMostHeld) break;
    held.push_back(k);
  }
  parallel_for(held.size(), [&](std::size_t i) { add(index, tolerances, held[i]); });
}

void WholeLevels::add(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, int level) {
  Level& whole = levels_[static_cast<std::size_t>(level)].emplace();
  whole.surface = triangulate_region(index, levels_from(level, tolerances), bounds_);
  whole.of_square = {
      static_cast<std::size_t>(kSquares * kSquares), whole.surface.mesh.triangles.size(),
      [&](std::uint32_t t, const auto& add_to) { for_each_square(whole.surface.box_of_triangle(t), add_to); }};
}

template <class Visit>
void WholeLevels::for_each_square(const GridBox& box, const Visit& visit) const {
  const auto place = [](std::int64_t v, std::int64_t low, std::int64_t high) {
    return std::clamp((v - low) * kSquares / (high - low + 1), std::int64_t{0}, kSquares - 1);
  };
  const std::int64_t west = place(box.xmin, bounds_.xmin, bounds_.xmax),
                     east = place(box.xmax, bounds_.xmin, bounds_.xmax),
                     south = place(box.ymin, bounds_.ymin, bounds_.ymax),
                     north = place(box.ymax, bounds_.ymin, bounds_.ymax);
  for (std::int64_t row = south; row <= north; ++row)
    for (std::int64_t column = west; column <= east; ++column) visit(static_cast<std::size_t>(row * kSquares + column));
}

std::optional<RegionMesh> WholeLevels::in(int level, const GridBox& box) const {
  const std::optional<Level>& whole = levels_[static_cast<std::size_t>(level)];
  if (!whole) return std::nullopt;
  std::vector<std::uint32_t> kept;
  for_each_square(box, [&](std::size_t square) {
    for (const std::uint32_t t : whole->of_square.in(square))
      if (triangle_meets(whole->surface.corners(t), box)) kept.push_back(t);
  });
  sort_unique(kept);
  return with_triangles(whole->surface, kept);
}

}  // namespace itin
