#include "verify/feature_heights.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/grid_units.hpp>

#include "store/codec/store_format.hpp"
#include "verify/leaf_cover.hpp"
#include "verify/merged_leaves.hpp"
#include "verify/tiling.hpp"

namespace itin {

namespace {

/// The grid steps by which the ground that features were raised on may differ from the ground under them.
constexpr double kHeightRounding = 2;
/// The most vertices of a part, and points of the terrain, in a tile.
constexpr double kVertices = 4096, kPoints = 1 << 15;

int tree_of(const Store& store, std::size_t part) {
  return format::vertex_tree(static_cast<int>(store.metadata().themes.size() + part + 1));
}

}  // namespace

PartHeights::PartHeights(const Store& store, std::size_t part)
    : store_(store),
      file_(file_of(store)),
      theme_(store.metadata().themes[store.metadata().parts[part].theme - std::size_t{1}]),
      tree_(tree_of(store, part)),
      ground_(selection_of(store.metadata(), Detail::tolerance(0), ThemeChoice::none())),
      selection_(selection_of(store.metadata(), Detail::tolerance(0), ThemeChoice::parse(theme_.name))),
      raised_(store, selection_),
      founded_(store.metadata().has_foundations) {
  const std::vector<ThemePart>& parts = store.metadata().parts;
  for (std::size_t other = 0; other < parts.size(); ++other)
    if (other != part && parts[other].theme == parts[part].theme) other_trees_.push_back(tree_of(store, other));
}

double PartHeights::vertices_in(const Cell& cell) const {
  std::vector<Leaf> leaves;
  file_.leaves_of(tree_, cell.box(), leaves);
  double count = 0;
  for (const Leaf& leaf : leaves)
    count += std::ldexp(leaf.points, 2 * std::min(0, cell.log2_side - leaf.cell.log2_side));
  return count;
}

std::vector<Cell> PartHeights::tiles() const {
  const Grid& grid = store_.metadata().grid;
  const auto full = [&](const Cell& cell) {
    const double vertices = vertices_in(cell);
    if (vertices == 0) return 0.0;
    const double points = static_cast<double>(store_.points_about(0, grid.box(cell.box())));
    return std::max(vertices / kVertices, points / kPoints);
  };
  std::vector<Cell> tiles = tiles_of(full, 1);
  std::erase_if(tiles, [&](const Cell& cell) { return vertices_in(cell) == 0; });
  return tiles;
}

/// Returns the codes of the part's vertices, along the curve.
std::vector<std::uint64_t> PartHeights::codes_in(const GridBox& box) const {
  std::vector<Leaf> leaves;
  file_.leaves_of(tree_, box, leaves);
  std::vector<std::uint64_t> codes;
  for (const Leaf& leaf : leaves) {
    if (leaf.points == 0) continue;
    const auto block = file_.block(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k)
      if (block->sources[k] != format::kMask) codes.push_back(code_of(block->points[k]));
  }
  return codes;
}

/// Returns the triangles that are part of one of the part's features.
std::vector<std::uint32_t> PartHeights::features_of(const RegionMesh& mesh, const GridBox& box) const {
  const std::vector<std::uint64_t> codes = codes_in(box);
  std::vector<std::uint32_t> features;
  for (std::uint32_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const auto& corners = mesh.mesh.triangles[t];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
          return (founded_ || mesh.vertices[v].theme != 0) &&
                 std::binary_search(codes.begin(), codes.end(), code_of(mesh.vertices[v]));
        }))
      features.push_back(t);
  }
  return features;
}

/// Returns the leaves about a box. Ground that foundations bend may depend on several parts, and is as low as the
/// deepest of them, so that their leaves are merged.
std::vector<Leaf> PartHeights::leaves_about(const GridBox& box) const {
  std::vector<Leaf> leaves;
  file_.leaves_of(tree_, box, leaves);
  if (!founded_) return leaves;
  for (const int other : other_trees_) {
    std::vector<Leaf> of_other;
    file_.leaves_of(other, box, of_other);
    leaves = merged_leaves(leaves, of_other);
  }
  return leaves;
}

std::vector<FalseCell> PartHeights::higher_in(const Cell& tile) const {
  const RegionMesh raised = triangulate_region(raised_, selection_, square_of(tile));
  const std::vector<std::uint32_t> features = features_of(raised, square_of(tile));
  if (features.empty()) return {};
  GridBox box;
  for (const std::uint32_t t : features) box.extend(raised.box_of_triangle(t));
  const RegionMesh bare = triangulate_region(file_, ground_, box);
  const HeightDifference difference(bare);
  const LeafCover cover(leaves_about(box));
  std::vector<Extremes> of_leaves(cover.leaves().size());
  Extremes beside;  // outside all leaves
  for (const std::uint32_t t : features) {
    cover.visit(
        raised.corners(t),
        [&](std::size_t i) { difference.add(raised, t, square_of(cover.leaves()[i].cell), of_leaves[i]); },
        [&](const Cell& gap) { difference.add(raised, t, square_of(gap), beside); });
  }
  std::vector<FalseCell> found;
  for (std::size_t i = 0; i < of_leaves.size(); ++i)
    if (of_leaves[i].hi > cover.leaves()[i].hi + kHeightRounding || too_deep(of_leaves[i], cover.leaves()[i].lo))
      found.push_back({tree_, cover.leaves()[i], of_leaves[i]});
  if (beside.hi > kHeightRounding || too_deep(beside, 0)) found.push_back({tree_, std::nullopt, beside});
  return found;
}

bool PartHeights::too_deep(const Extremes& differs, std::int32_t lowest) const {
  return founded_ && differs.lo < lowest - kHeightRounding;
}

Damage PartHeights::higher(const FalseCell& cell) const {
  const Grid& grid = file_.metadata().grid;
  const std::int32_t lowest = cell.leaf ? cell.leaf->lo : 0;
  if (too_deep(cell.differs, lowest))
    return {cell.leaf ? format::place("directory", cell.leaf->key) : fmt::format("tree {}", tree_),
            fmt::format("theme '{}' cuts {:.2f} m into the ground, where the index says at most {:.2f} m", theme_.name,
                        -cell.differs.lo * grid.resolution, -lowest * grid.resolution)};
  const Point2 at = place_in_metres(grid, cell.differs.highest);
  return {
      cell.leaf ? format::place("directory", cell.leaf->key) : fmt::format("tree {}", tree_),
      fmt::format("theme '{}' rises {:.2f} m above the ground at {:.2f},{:.2f}, where the index says at most {:.2f} m",
                  theme_.name, cell.differs.hi * grid.resolution, at.x, at.y,
                  cell.leaf ? cell.leaf->hi * grid.resolution : 0.0)};
}

}  // namespace itin
