#include <algorithm>
#include <atomic>
#include <numeric>

#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>

#include "store/cell.hpp"

namespace itin {

namespace {

constexpr std::size_t kChunk = 1 << 14;
/// Of a lattice's cells at least one in so many has ground.
constexpr std::int64_t kEmptiest = 4;

GridBox box_of(const Tin& tin, const Triangle& t) {
  GridBox box;
  for (const std::uint32_t v : t) box.extend(tin.vertices[v].x, tin.vertices[v].y);
  return box;
}

/// The half of the box that the triangle is; 0 where it is none.
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

}  // namespace

std::size_t LatticeTin::triangle_count() const {
  return std::accumulate(halves.begin(), halves.end(), std::size_t{0}, [](std::size_t sum, std::uint8_t cell) {
    return sum + ((cell & kFirst) != 0 ? 1 : 0) + ((cell & kSecond) != 0 ? 1 : 0);
  });
}

std::vector<RimEdge> LatticeTin::rim() const {
  std::vector<std::vector<RimEdge>> of_rows(rows);
  parallel_for(rows, [&](std::size_t r) {
    const auto row = static_cast<std::uint32_t>(r);
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::size_t cell = index(column, row);
      const std::uint8_t there = halves[cell];
      if (there == 0 ||
          (whole(cell) && whole(cell - 1) && whole(cell + 1) && whole(cell - columns) && whole(cell + columns)))
        continue;
      const GridPoint nw = post(column, row), ne = post(column + 1, row), sw = post(column, row + 1),
                      se = post(column + 1, row + 1);
      const auto add = [&](std::uint8_t here, std::uint8_t beyond, const GridPoint& from, const GridPoint& to) {
        if ((there & here) != 0 && beyond == 0) of_rows[r].push_back({from, to});
      };
      add(kSouthWest | kSouthEast, halves[cell + columns] & (kNorthWest | kNorthEast), sw, se);
      add(kNorthEast | kSouthEast, halves[cell + 1] & (kNorthWest | kSouthWest), se, ne);
      add(kNorthWest | kNorthEast, halves[cell - columns] & (kSouthWest | kSouthEast), ne, nw);
      add(kNorthWest | kSouthWest, halves[cell - 1] & (kNorthEast | kSouthEast), nw, sw);
      add(kSouthWest, there & kNorthEast, se, nw);
      add(kNorthEast, there & kSouthWest, nw, se);
      add(kNorthWest, there & kSouthEast, sw, ne);
      add(kSouthEast, there & kNorthWest, ne, sw);
    }
  });
  std::vector<RimEdge> result;
  for (const std::vector<RimEdge>& row : of_rows) result.insert(result.end(), row.begin(), row.end());
  return result;
}

Box LatticeTin::bounds() const {
  GridBox box;
  const auto there = [](std::uint8_t cell) { return cell != 0; };
  for (std::uint32_t row = 0; row < rows; ++row) {
    const auto first = halves.begin() + static_cast<std::ptrdiff_t>(index(0, row)), end = first + columns;
    const auto west_most = std::find_if(first, end, there);
    if (west_most == end) continue;
    const auto east_most = std::find_if(std::reverse_iterator(end), std::reverse_iterator(first), there);
    box.extend(x(static_cast<std::uint32_t>(west_most - first)), y(row));
    box.extend(x(static_cast<std::uint32_t>(east_most.base() - first)), y(row + 1));
  }
  return grid.box(box);
}

Tin LatticeTin::tin() const {
  struct Used {
    std::uint64_t code;
    std::size_t post;
  };
  std::vector<Used> used;
  std::vector<std::uint32_t> number(heights.size(), 0);
  const auto index_of = [&](const GridPoint& p) {
    return index(static_cast<std::uint32_t>((p.x - west) / spacing),
                 static_cast<std::uint32_t>((north - p.y) / spacing));
  };
  for (std::size_t cell = 0; cell < halves.size(); ++cell) {
    for_each_triangle(cell, [&](std::uint32_t t) {
      for (const GridPoint& p : corners(t)) {
        const std::size_t post = index_of(p);
        if (number[post] == 0) used.push_back({code_of(p), post});
        number[post] = 1;
      }
      return true;
    });
  }
  std::sort(used.begin(), used.end(), [](const Used& a, const Used& b) { return a.code < b.code; });
  Tin result;
  result.grid = grid;
  result.statistics = statistics;
  for (const Used& u : used) {
    number[u.post] = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.push_back(
        post(static_cast<std::uint32_t>(u.post % columns), static_cast<std::uint32_t>(u.post / columns)));
  }
  for (std::size_t cell = 0; cell < halves.size(); ++cell) {
    for_each_triangle(cell, [&](std::uint32_t t) {
      const auto [a, b, c] = corners(t);
      Triangle triangle{number[index_of(a)], number[index_of(b)], number[index_of(c)]};
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      result.triangles.push_back(triangle);
      return true;
    });
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

std::optional<LatticeTin> lattice_of(const Tin& tin) {
  const std::size_t count = tin.triangles.size();
  if (count == 0 || !tin.standing.empty()) return std::nullopt;
  const GridBox first = box_of(tin, tin.triangles[0]);
  GridBox all;
  for (const GridPoint& v : tin.vertices) all.extend(v.x, v.y);
  const std::int64_t spacing = std::int64_t{first.xmax} - first.xmin;
  if (spacing != std::int64_t{first.ymax} - first.ymin) return std::nullopt;
  const std::int64_t west = all.xmin - spacing, north = all.ymax + spacing;
  const std::int64_t columns = (all.xmax - west) / spacing + 1, rows = (north - all.ymin) / spacing + 1;
  if (columns * rows > kEmptiest * static_cast<std::int64_t>(count) / 2 + 4 * (columns + rows)) return std::nullopt;
  LatticeTin lattice{tin.grid,
                     static_cast<std::int32_t>(west),
                     static_cast<std::int32_t>(north),
                     static_cast<std::int32_t>(spacing),
                     static_cast<std::uint32_t>(columns),
                     static_cast<std::uint32_t>(rows),
                     {},
                     std::vector<std::uint8_t>(static_cast<std::size_t>(columns * rows)),
                     tin.statistics};
  // Triangles of one cell may be dealt with by two threads.
  const auto add = [&](std::size_t cell, std::uint8_t half) {
    std::atomic_ref(lattice.halves[cell]).fetch_or(half, std::memory_order_relaxed);
  };
  std::atomic<bool> odd = false;
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t t = chunk * kChunk; t < std::min(count, (chunk + 1) * kChunk) && !odd; ++t) {
      const GridBox box = box_of(tin, tin.triangles[t]);
      const std::int64_t east = box.xmin - west, south = north - box.ymax, column = east / spacing,
                         row = south / spacing;
      const std::uint8_t half = half_of(tin, tin.triangles[t], box);
      if (half == 0 || column * spacing != east || row * spacing != south ||
          std::int64_t{box.xmax} - box.xmin != spacing || std::int64_t{box.ymax} - box.ymin != spacing) {
        odd = true;
        return;
      }
      add(static_cast<std::size_t>(row * columns + column), half);
    }
  });
  if (odd) return std::nullopt;
  lattice.heights.assign(lattice.halves.size(), LatticeTin::kNoPost);
  for (const GridPoint& v : tin.vertices)
    lattice.heights[static_cast<std::size_t>((north - v.y) / spacing * columns + (v.x - west) / spacing)] = v.z;
  return lattice;
}

}  // namespace itin
