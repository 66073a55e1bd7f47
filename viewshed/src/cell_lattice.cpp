#include "cell_lattice.hpp"

#include <algorithm>
#include <atomic>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

constexpr std::size_t kChunk = 1 << 14;
/// Of a grid's cells at least one in so many has ground.
constexpr std::int64_t kEmptiest = 4;

/// Grid units.
GridBox box_of(const Tin& tin, const Triangle& t) {
  GridBox box;
  for (const std::uint32_t v : t) box.extend(tin.vertices[v].x, tin.vertices[v].y);
  return box;
}

GridBox box_of(const Tin& tin) {
  GridBox box;
  for (const GridPoint& v : tin.vertices) box.extend(v.x, v.y);
  return box;
}

bool at_corners(const Tin& tin, const Triangle& t, const GridBox& box) {
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) {
    const GridPoint& v = tin.vertices[i];
    return (v.x == box.xmin || v.x == box.xmax) && (v.y == box.ymin || v.y == box.ymax);
  });
}

/// Sides of a cell.
enum Side : std::uint8_t { kNorth = 1, kEast = 2, kSouth = 4, kWest = 8, kAll = 15, kDiagonal = 0 };

Side side_of(const GridPoint& p, const GridPoint& q, const GridBox& cell) {
  if (p.y == q.y) return p.y == cell.ymax ? kNorth : kSouth;
  if (p.x == q.x) return p.x == cell.xmax ? kEast : kWest;
  return kDiagonal;
}

/// Which sides of a lattice's cells its triangles have as edges.
class CoveredSides {
 public:
  CoveredSides(const Tin& tin, const CellLattice& lattice)
      : columns_(static_cast<std::size_t>(lattice.grid.columns())),
        held_(lattice.grid.cell_count()),
        sides_(lattice.grid.cell_count()) {
    for (const std::uint32_t cell : lattice.cell_of) ++held_[cell];
    for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
      const std::uint32_t cell = lattice.cell_of[t];
      sides_[cell] = held_[cell] == 2 ? std::uint8_t{kAll} : sides_of(tin, tin.triangles[t]);
    }
  }

  bool whole(std::size_t cell) const { return sides_[cell] == kAll; }
  bool amid_whole(std::size_t cell) const {
    return whole(cell) && whole(cell - 1) && whole(cell + 1) && whole(cell - columns_) && whole(cell + columns_);
  }
  /// Whether there is a triangle across the edge of one in the cell.
  bool has_twin(std::size_t cell, Side side) const {
    switch (side) {
      case kNorth:
        return (sides_[cell - columns_] & kSouth) != 0;
      case kEast:
        return (sides_[cell + 1] & kWest) != 0;
      case kSouth:
        return (sides_[cell + columns_] & kNorth) != 0;
      case kWest:
        return (sides_[cell - 1] & kEast) != 0;
      default:
        return held_[cell] == 2;
    }
  }

 private:
  static std::uint8_t sides_of(const Tin& tin, const Triangle& t) {
    const GridBox box = box_of(tin, t);
    std::uint8_t sides = 0;
    for (std::size_t i = 0; i < 3; ++i) sides |= side_of(tin.vertices[t[i]], tin.vertices[t[(i + 1) % 3]], box);
    return sides;
  }

  std::size_t columns_;
  std::vector<std::uint8_t> held_, sides_;  ///< a cell
};

}  // namespace

std::optional<CellLattice> cell_lattice(const Tin& tin) {
  const std::size_t count = tin.triangles.size();
  if (count == 0) return std::nullopt;
  const GridBox first = box_of(tin, tin.triangles[0]), all = box_of(tin);
  const std::int64_t spacing = std::int64_t{first.xmax} - first.xmin;
  if (spacing != std::int64_t{first.ymax} - first.ymin) return std::nullopt;
  const std::int64_t west = all.xmin - spacing, north = all.ymax + spacing;
  const std::int64_t columns = (all.xmax - west) / spacing + 1, rows = (north - all.ymin) / spacing + 1;
  if (columns * rows > kEmptiest * static_cast<std::int64_t>(count) / 2 + 4 * (columns + rows)) return std::nullopt;
  CellLattice lattice;
  lattice.cell_of.resize(count);
  std::atomic<bool> odd = false;
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t t = chunk * kChunk; t < std::min(count, (chunk + 1) * kChunk) && !odd; ++t) {
      const GridBox box = box_of(tin, tin.triangles[t]);
      const std::int64_t east = box.xmin - west, south = north - box.ymax, column = east / spacing,
                         row = south / spacing;
      if (column * spacing != east || row * spacing != south || std::int64_t{box.xmax} - box.xmin != spacing ||
          std::int64_t{box.ymax} - box.ymin != spacing || !at_corners(tin, tin.triangles[t], box)) {
        odd = true;
        return;
      }
      lattice.cell_of[t] = static_cast<std::uint32_t>(row * columns + column);
    }
  });
  if (odd) return std::nullopt;
  lattice.posts.assign(static_cast<std::size_t>(columns * rows), CellLattice::kNoPost);
  const double a_unit = 1 / static_cast<double>(spacing);
  for (const GridPoint& v : tin.vertices) {
    // Whole numbers but for rounding, which the quarter swallows.
    const auto column = static_cast<std::int64_t>(static_cast<double>(v.x - west) * a_unit + 0.25);
    const auto row = static_cast<std::int64_t>(static_cast<double>(north - v.y) * a_unit + 0.25);
    lattice.posts[static_cast<std::size_t>(row * columns + column)] = v.z;
  }
  const double unit = tin.grid.resolution, cell = static_cast<double>(spacing) * unit;
  lattice.grid = {
      {tin.grid.origin.x + static_cast<double>(west) * unit, tin.grid.origin.y + static_cast<double>(north) * unit},
      cell,
      cell,
      columns,
      rows};
  return lattice;
}

std::vector<BoundaryEdge> boundary_edges(const Tin& tin, const CellLattice& lattice) {
  const CoveredSides covered(tin, lattice);
  std::vector<BoundaryEdge> edges;
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    const std::uint32_t cell = lattice.cell_of[t];
    if (covered.amid_whole(cell)) continue;
    const Triangle& corners = tin.triangles[t];
    const GridBox box = box_of(tin, corners);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (!covered.has_twin(cell, side_of(tin.vertices[from], tin.vertices[to], box)))
        edges.push_back({from, to, static_cast<std::uint32_t>(t)});
    }
  }
  return edges;
}

}  // namespace itin::viewshed
