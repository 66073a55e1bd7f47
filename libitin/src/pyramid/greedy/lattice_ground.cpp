#include "pyramid/greedy/lattice_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace itin {

LatticeGround::LatticeGround(const std::vector<SelectedVertex>& vertices, const LatticePosts& posts,
                             std::span<const Candidacy> candidacy)
    : vertices_(vertices), posts_(posts), heights_(posts.places(), kMissing) {
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const std::uint32_t v = posts.vertex_at(i);
    if (v == kNoVertex || candidacy[v] == Candidacy::kNone) continue;
    heights_[i] = point(v).z;
    if (candidacy[v] != Candidacy::kSpare) continue;
    spare_.resize(heights_.size(), 0);
    spare_[i] = 1;
  }
}

WorstPoint LatticeGround::worst_point(std::uint32_t, const std::array<std::uint32_t, 3>& vertices) const {
  struct Corner {
    double column, row, z;
  };
  std::array<Corner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const LatticePlace place = posts_.place_of(point(vertices[i]));
    corners[i] = {static_cast<double>(place.column), static_cast<double>(place.row),
                  static_cast<double>(height(place))};
  }
  const auto& [a, b, c] = corners;
  const double bx = b.column - a.column, by = b.row - a.row, bz = b.z - a.z;
  const double cx = c.column - a.column, cy = c.row - a.row, cz = c.z - a.z;
  const double area = bx * cy - by * cx;
  if (area == 1) return {};  // the triangle holds no other post (Pick 1899)
  const double rise_x = (bz * cy - cz * by) / area, rise_y = (bx * cz - cx * bz) / area;
  // A side is seen counterclockwise: a rising one bounds rows on the east, a falling one on the west.
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
  double error_of_free = 0, error_of_spare = 0;
  std::size_t free_post = 0, spare_post = 0;
  const double south = std::min({a.row, b.row, c.row}), north = std::max({a.row, b.row, c.row});
  for (double row = south; row <= north; ++row) {
    double from = west[0].at(row), to = east[0].at(row);
    if (west_bounds > 1) from = std::max(from, west[1].at(row));
    if (east_bounds > 1) to = std::min(to, east[1].at(row));
    const auto first = static_cast<std::int64_t>(from + (1 - kSlack)), last = static_cast<std::int64_t>(to + kSlack);
    const std::size_t start = posts_.index(0, static_cast<std::int64_t>(row));
    const double at_row = a.z + (row - a.row) * rise_y;
    for (std::int64_t column = first; column <= last; ++column) {
      const std::int32_t z = heights_[start + static_cast<std::size_t>(column)];
      const double error = std::abs(z - (at_row + (static_cast<double>(column) - a.column) * rise_x));
      if (error <= error_of_free || z == kMissing) continue;
      const std::size_t post = start + static_cast<std::size_t>(column);
      if (spare_.empty() || spare_[post] == 0) {
        error_of_free = error, free_post = post;
      } else if (error > error_of_spare) {
        error_of_spare = error, spare_post = post;
      }
    }
  }
  const double error = std::max(error_of_free, error_of_spare);
  if (error == 0) return {};
  // Corners of the face are off it by rounding alone.
  return {error, posts_.vertex_at(error_of_free > kPointError ? free_post : spare_post)};
}

}  // namespace itin
