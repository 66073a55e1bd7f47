#include "pyramid/lattice_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace itin {

namespace {

/// Far fewer posts than places would cost memory, and rows that are walked in vain.
constexpr double kLeastShare = 1.0 / 16;
/// The share of posts with neighbours to the east and north. Where it is less, most full edges are no sides.
constexpr double kLeastWithNeighbours = 0.5;

/// The greatest step with which all coordinates are met from the first on; 1 where all are the first.
std::int64_t common_step(std::span<const SelectedVertex> vertices, std::span<const Candidacy> candidacy,
                         std::int32_t GridPoint::*axis, std::int32_t first) {
  std::int64_t step = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (candidacy[v] != Candidacy::kNone) step = std::gcd(step, std::int64_t{vertices[v].point.*axis} - first);
  return std::max<std::int64_t>(step, 1);
}

}  // namespace

std::optional<LatticeGround> LatticeGround::of(std::span<const SelectedVertex> vertices,
                                               std::span<const Candidacy> candidacy) {
  LatticeGround ground(vertices);
  if (!ground.place(candidacy)) return std::nullopt;
  return ground;
}

bool LatticeGround::place(std::span<const Candidacy> candidacy) {
  GridBox box;
  std::size_t candidates = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (candidacy[v] == Candidacy::kNone) continue;
    box.extend(vertices_[v].point.x, vertices_[v].point.y);
    ++candidates;
  }
  if (candidates == 0) return false;
  const std::int64_t step_x = common_step(vertices_, candidacy, &GridPoint::x, box.xmin),
                     step_y = common_step(vertices_, candidacy, &GridPoint::y, box.ymin);
  columns_ = (std::int64_t{box.xmax} - box.xmin) / step_x + 1, rows_ = (std::int64_t{box.ymax} - box.ymin) / step_y + 1;
  if (static_cast<double>(candidates) < kLeastShare * static_cast<double>(columns_) * static_cast<double>(rows_))
    return false;
  west_ = box.xmin, south_ = box.ymin;
  constexpr double kMoreThanOne = 1 + 1e-12;
  columns_per_unit_ = kMoreThanOne / static_cast<double>(step_x);
  rows_per_unit_ = kMoreThanOne / static_cast<double>(step_y);
  heights_.assign(post(0, rows_), kMissing);
  numbers_.assign(post(0, rows_), kNoVertex);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (candidacy[v] == Candidacy::kNone) continue;
    const LatticePlace place = place_of(point(v));
    heights_[post(place.column, place.row)] = point(v).z;
    numbers_[post(place.column, place.row)] = v;
  }
  return rows_ == 1 || columns_ == 1 ||
         static_cast<double>(count_with_neighbours()) >= kLeastWithNeighbours * static_cast<double>(candidates);
}

/// Posts with neighbours to the east and north.
std::size_t LatticeGround::count_with_neighbours() const {
  std::size_t count = 0;
  for (std::int64_t row = 0; row + 1 < rows_; ++row) {
    for (std::int64_t column = 0; column + 1 < columns_; ++column) {
      count += height({column, row}) != kMissing && height({column + 1, row}) != kMissing &&
               height({column, row + 1}) != kMissing;
    }
  }
  return count;
}

std::uint32_t LatticeGround::vertex(const LatticePlace& place) const {
  const bool inside = place.column >= 0 && place.column < columns_ && place.row >= 0 && place.row < rows_;
  return inside ? numbers_[post(place.column, place.row)] : kNoVertex;
}

WorstPoint LatticeGround::worst_point(CoarseFace face) const {
  struct Corner {
    double column, row, z;
  };
  std::array<Corner, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const LatticePlace place = place_of(face->vertex(i)->point());
    corners[static_cast<std::size_t>(i)] = {static_cast<double>(place.column), static_cast<double>(place.row),
                                            static_cast<double>(height(place))};
  }
  const auto& [a, b, c] = corners;
  const double bx = b.column - a.column, by = b.row - a.row, bz = b.z - a.z;
  const double cx = c.column - a.column, cy = c.row - a.row, cz = c.z - a.z;
  const double area = bx * cy - by * cx;
  if (area == 1) return {};  // it holds no other post (Pick 1899)
  const double rise_x = (bz * cy - cz * by) / area, rise_y = (bx * cz - cx * bz) / area;
  // Sides as seen counterclockwise: a rising one bounds rows on the east, a falling one on the west.
  struct Bound {
    double column, row, slope;
    double at(double r) const { return column + (r - row) * slope; }
  };
  std::array<Bound, 2> west, east;
  std::size_t west_bounds = 0, east_bounds = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &p = corners[i], &q = corners[(i + 1) % 3];
    if (p.row == q.row) continue;
    const Bound bound{p.column, p.row, (q.column - p.column) / (q.row - p.row)};
    (p.row < q.row ? east[east_bounds++] : west[west_bounds++]) = bound;
  }
  // Another post is farther from a side than this, and rounding is less.
  constexpr double kSlack = 1e-7;
  WorstPoint worst;
  std::size_t worst_post = 0;
  const double south = std::min({a.row, b.row, c.row}), north = std::max({a.row, b.row, c.row});
  for (double row = south; row <= north; ++row) {
    double from = west[0].at(row), to = east[0].at(row);
    if (west_bounds > 1) from = std::max(from, west[1].at(row));
    if (east_bounds > 1) to = std::min(to, east[1].at(row));
    const auto first = static_cast<std::int64_t>(from + (1 - kSlack)), last = static_cast<std::int64_t>(to + kSlack);
    const std::size_t start = post(0, static_cast<std::int64_t>(row));
    const double at_row = a.z + (row - a.row) * rise_y;
    for (std::int64_t column = first; column <= last; ++column) {
      const std::int32_t z = heights_[start + static_cast<std::size_t>(column)];
      const double error = std::abs(z - (at_row + (static_cast<double>(column) - a.column) * rise_x));
      if (error > worst.error && z != kMissing) {
        worst.error = error;
        worst_post = start + static_cast<std::size_t>(column);
      }
    }
  }
  if (worst.error > 0) worst.point = numbers_[worst_post];
  return worst;
}

}  // namespace itin
