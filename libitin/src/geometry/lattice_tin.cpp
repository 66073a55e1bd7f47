#include <algorithm>
#include <atomic>

#include <itin/box_of.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>
#include <itin/precondition.hpp>

#include "geometry/cell.hpp"
#include "geometry/lattice_edges.hpp"

namespace itin {

namespace {

constexpr std::size_t kChunk = 1 << 14;
/// A Tin counts as a lattice only if at least one in this many of the lattice's cells has ground.
constexpr std::int64_t kEmptiest = 4;

/// Returns the half of the box that the triangle is; 0 where it is none.
std::uint8_t half_of(const Tin& tin, const Triangle& t, const GridBox& box) {
  std::uint8_t corners = 0;
  for (const std::uint32_t i : t) {
    const GridPoint& v = tin.vertices[i];
    if ((v.x != box.xmin && v.x != box.xmax) || (v.y != box.ymin && v.y != box.ymax)) return 0;
    const bool east = v.x == box.xmax, north = v.y == box.ymax;
    corners |= north ? (east ? LatticeTin::kNorthEast : LatticeTin::kNorthWest)
                     : (east ? LatticeTin::kSouthEast : LatticeTin::kSouthWest);
  }
  // The right angle is opposite the corner that is missing.
  switch (corners ^ (LatticeTin::kFalling | LatticeTin::kRising)) {
    case LatticeTin::kNorthEast:
      return LatticeTin::kSouthWest;
    case LatticeTin::kSouthWest:
      return LatticeTin::kNorthEast;
    case LatticeTin::kSouthEast:
      return LatticeTin::kNorthWest;
    default:
      return LatticeTin::kSouthEast;
  }
}

/// Returns how many triangles these halves are.
std::uint64_t count_of(std::uint8_t halves) {
  return ((halves & LatticeTin::kFirst) != 0 ? 1U : 0U) + ((halves & LatticeTin::kSecond) != 0 ? 1U : 0U);
}

}  // namespace

void LatticeTin::classify_tile(std::uint32_t tile) {
  Tile& t = tiles[tile];
  const auto all = [&](std::uint8_t halves) {
    return std::all_of(t.halves->begin(), t.halves->end(), [&](std::uint8_t cell) { return cell == halves; });
  };
  t.ground = all(0) ? Ground::kNone : all(kFalling) ? Ground::kWhole : Ground::kPartly;
  if (t.ground != Ground::kPartly) t.halves.reset();
  if (t.ground == Ground::kNone) t.heights.reset();
}

std::uint64_t LatticeTin::triangle_count() const {
  std::uint64_t count = 0;
  for (const Tile& tile : tiles) {
    if (tile.ground == Ground::kWhole) count += 2 * kCells;
    if (tile.ground != Ground::kPartly) continue;
    for (const std::uint8_t halves : *tile.halves) count += count_of(halves);
  }
  return count;
}

std::vector<RimEdge> LatticeTin::rim() const {
  std::vector<std::vector<RimEdge>> of_tiles(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t tile) {
    const auto there = [&](std::int64_t column, std::int64_t row) {
      return int{halves(cell(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)))};
    };
    for_each_open_edge_of(*this, static_cast<std::uint32_t>(tile), there,
                          [&](std::int64_t column, std::int64_t row, std::size_t direction) {
                            const LatticeStep& step = kLatticeSteps[direction];
                            const auto place = [&](std::int64_t c, std::int64_t r) {
                              return GridPlace{x(static_cast<std::uint32_t>(c)), y(static_cast<std::uint32_t>(r))};
                            };
                            of_tiles[tile].push_back({place(column, row), place(column + step.dx, row - step.dy)});
                          });
  });
  std::vector<RimEdge> result;
  for (const std::vector<RimEdge>& edges : of_tiles) result.insert(result.end(), edges.begin(), edges.end());
  return result;
}

Box LatticeTin::bounds() const {
  GridBox box;
  const auto extend = [&](std::uint32_t first_column, std::uint32_t first_row, std::uint32_t side) {
    box.extend(x(first_column), y(first_row));
    box.extend(x(first_column + side), y(first_row + side));
  };
  for (std::uint32_t t = 0; t < tiles.size(); ++t) {
    const std::uint32_t first = t << 2 * kBits;
    if (tiles[t].ground == Ground::kWhole) extend(column_of(first), row_of(first), kSide);
    if (tiles[t].ground != Ground::kPartly) continue;
    for (std::uint32_t cell = first; cell < first + kCells; ++cell)
      if (halves(cell) != 0) extend(column_of(cell), row_of(cell), 1);
  }
  return grid.box(box);
}

Tin LatticeTin::tin() const {
  ITIN_PRECONDITION(std::all_of(tiles.begin(), tiles.end(),
                                [](const auto& tile) { return tile.ground == Ground::kNone || tile.heights; }));
  struct Used {
    std::uint64_t code;
    std::size_t post;
    std::int32_t height;
  };
  std::vector<Used> used;
  std::vector<std::uint32_t> number(std::size_t{columns} * rows, 0);
  const auto index_of = [&](const GridPoint& p) {
    return static_cast<std::size_t>((north - p.y) / spacing) * columns +
           static_cast<std::size_t>((p.x - west) / spacing);
  };
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t cell = 0; cell < tiles.size() << 2 * kBits; ++cell)
      for_each_triangle(cell, [&](std::uint32_t t) {
        visit(corners(t));
        return true;
      });
  };
  for_each([&](const std::array<GridPoint, 3>& triangle) {
    for (const GridPoint& p : triangle) {
      const std::size_t post = index_of(p);
      if (number[post] == 0) used.push_back({code_of(p), post, p.z});
      number[post] = 1;
    }
  });
  std::sort(used.begin(), used.end(), [](const Used& a, const Used& b) { return a.code < b.code; });
  Tin result;
  result.grid = grid;
  result.statistics = statistics;
  for (const Used& u : used) {
    number[u.post] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(
        {x(static_cast<std::uint32_t>(u.post % columns)), y(static_cast<std::uint32_t>(u.post / columns)), u.height});
  }
  for_each([&](const std::array<GridPoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    Triangle triangle{number[index_of(a)], number[index_of(b)], number[index_of(c)]};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    result.triangles.push_back(triangle);
  });
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

namespace {

/// Makes a lattice over all of the Tin's vertices, without cells. Returns nothing where the Tin's first triangle
/// belongs to no lattice, or most of the lattice would be empty.
std::optional<LatticeTin> lattice_about(const Tin& tin) {
  const GridBox first = box_of(tin.corners(0));
  const GridBox all = box_of(tin.vertices);
  const std::int64_t spacing = std::int64_t{first.xmax} - first.xmin;
  if (spacing != std::int64_t{first.ymax} - first.ymin) return std::nullopt;
  const std::int64_t west = all.xmin - spacing, north = all.ymax + spacing;
  const std::int64_t columns = (all.xmax - west) / spacing + 1, rows = (north - all.ymin) / spacing + 1;
  const auto count = static_cast<std::int64_t>(tin.triangles.size());
  if (columns * rows > kEmptiest * count / 2 + 4 * (columns + rows)) return std::nullopt;
  LatticeTin lattice;
  lattice.grid = tin.grid, lattice.statistics = tin.statistics;
  lattice.west = static_cast<std::int32_t>(west), lattice.north = static_cast<std::int32_t>(north);
  lattice.spacing = static_cast<std::int32_t>(spacing);
  lattice.columns = static_cast<std::uint32_t>(columns), lattice.rows = static_cast<std::uint32_t>(rows);
  lattice.tiles.resize(std::size_t{lattice.tile_columns()} * lattice.tile_rows());
  for (std::uint32_t t = 0; t < lattice.tiles.size(); ++t) {
    lattice.tiles[t].halves = std::make_unique<std::array<std::uint8_t, LatticeTin::kCells>>();
    lattice.make_heights(t);
  }
  return lattice;
}

/// Adds the triangle to its cell; any thread may call it. Returns false where the triangle is not half a cell.
bool add(const Tin& tin, const Triangle& triangle, LatticeTin& lattice) {
  const GridBox box = box_of(triangle, [&](std::uint32_t v) { return tin.vertices[v]; });
  const std::int64_t spacing = lattice.spacing;
  const std::int64_t east = std::int64_t{box.xmin} - lattice.west, south = std::int64_t{lattice.north} - box.ymax,
                     column = east / spacing, row = south / spacing;
  const std::uint8_t half = half_of(tin, triangle, box);
  if (half == 0 || column * spacing != east || row * spacing != south || std::int64_t{box.xmax} - box.xmin != spacing ||
      std::int64_t{box.ymax} - box.ymin != spacing)
    return false;
  // Two threads may add the triangles of one cell.
  const std::uint32_t cell = lattice.cell(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
  std::uint8_t& halves = (*lattice.tiles[cell / LatticeTin::kCells].halves)[cell % LatticeTin::kCells];
  std::atomic_ref(halves).fetch_or(half, std::memory_order_relaxed);
  return true;
}

void set_heights(const Tin& tin, LatticeTin& lattice) {
  const auto [lowest, highest] = std::minmax_element(tin.vertices.begin(), tin.vertices.end(),
                                                     [](const GridPoint& a, const GridPoint& b) { return a.z < b.z; });
  lattice.lowest = lowest->z, lattice.highest = highest->z;
  const std::int64_t west = lattice.west, north = lattice.north;
  for (const GridPoint& v : tin.vertices)
    lattice.for_each_tile_of(
        static_cast<std::uint32_t>((v.x - west) / lattice.spacing),
        static_cast<std::uint32_t>((north - v.y) / lattice.spacing),
        [&](std::uint32_t tile, std::uint32_t post) { (*lattice.tiles[tile].heights)[post] = v.z; });
}

}  // namespace

std::optional<LatticeTin> lattice_of(const Tin& tin) {
  const std::size_t count = tin.triangles.size();
  if (count == 0 || !tin.raised_theme.empty()) return std::nullopt;
  std::optional<LatticeTin> lattice = lattice_about(tin);
  if (!lattice) return std::nullopt;
  std::atomic<bool> odd = false;
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t t = chunk * kChunk; t < std::min(count, (chunk + 1) * kChunk) && !odd; ++t)
      if (!add(tin, tin.triangles[t], *lattice)) odd = true;
  });
  if (odd) return std::nullopt;
  set_heights(tin, *lattice);
  for (std::uint32_t t = 0; t < lattice->tiles.size(); ++t) lattice->classify_tile(t);
  return lattice;
}

}  // namespace itin
