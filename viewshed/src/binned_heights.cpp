#include "binned_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RasterGrid bin_grid(const Tin& tin) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double width = std::max(box.width(), tin.grid.resolution), height = std::max(box.height(), tin.grid.resolution);
  const double bin = std::sqrt(2 * width * height / static_cast<double>(tin.triangles.size()));
  // Half a bin more than needed all around, so that the edges lie inside.
  const auto count = [&](double length) { return static_cast<std::int64_t>(std::ceil(length / bin)) + 1; };
  return {{box.xmin - bin / 2, box.ymax + bin / 2}, bin, bin, count(width), count(height)};
}

float rounded_down(double v) {
  const auto near = static_cast<float>(v);
  return near <= v ? near : std::nextafter(near, -kInfinity);
}
float rounded_up(double v) {
  return -rounded_down(-v);
}

/// A square with some slack, grid units.
struct Square {
  double x = 0, y = 0;  ///< its middle
  double half = 0;
};

struct Range {
  double low = 0, high = 0;
};

/// Of a triangle's plane over the square, but not beyond its vertices.
Range range_of(const GridPoint& a, const GridPoint& b, const GridPoint& c, const Square& square) {
  const double low = std::min({a.z, b.z, c.z}), high = std::max({a.z, b.z, c.z});
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z, cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double doubled_area = bx * cy - by * cx;
  if (doubled_area == 0) return {low, high};
  const double slope_x = (bz * cy - by * cz) / doubled_area, slope_y = (bx * cz - bz * cx) / doubled_area;
  const double rise_x = slope_x * (square.x - a.x), rise_y = slope_y * (square.y - a.y);
  // The last term covers the rounding of what stands before it.
  const double spread = (std::abs(slope_x) + std::abs(slope_y)) * square.half +
                        1e-12 * (std::abs(rise_x) + std::abs(rise_y) + std::abs(high - low));
  const double middle = a.z + rise_x + rise_y;
  return {std::max(low, middle - spread), std::min(high, middle + spread)};
}

}  // namespace

BinnedHeights::BinnedHeights(const Tin& tin, const std::vector<BoundaryEdge>& boundary)
    : units_(tin.grid),
      grid_(bin_grid(tin)),
      bins_(tin, grid_),
      tops_(tin.triangles.size()),
      low_by_row_(grid_.cell_count(), -kInfinity),
      high_by_row_(grid_.cell_count(), -kInfinity) {
  std::transform(tin.triangles.begin(), tin.triangles.end(), tops_.begin(), [&](const Triangle& t) {
    return std::max({tin.vertices[t[0]].z, tin.vertices[t[1]].z, tin.vertices[t[2]].z});
  });
  for (const GridPoint& v : tin.vertices)
    greatest_magnitude_ = std::max(greatest_magnitude_, std::abs(static_cast<double>(v.z)));
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t r) {
    for (std::int64_t c = 0; c < columns(); ++c) bound(tin, c, static_cast<std::int64_t>(r));
  });
  forget_depth_at(tin, boundary);
  transpose();
}

void BinnedHeights::bound(const Tin& tin, std::int64_t column, std::int64_t row) {
  const Point2 middle = grid_.centre(column, row);
  const Square square{(middle.x - units_.origin.x) / units_.resolution, (middle.y - units_.origin.y) / units_.resolution,
                      bin_size() * (0.5 + 2 * kSlack)};
  const auto listed = triangles(column, row);
  if (listed.empty()) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::uint32_t number : listed) {
    const Triangle& t = tin.triangles[number];
    const Range range = range_of(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]], square);
    // The plane of a triangle that only nearly meets the bin may leave its own heights: low > high.
    low = std::min(low, range.low), high = std::max(high, range.high);
  }
  const std::size_t bin = grid_.index({column, row});
  low_by_row_[bin] = rounded_down(low), high_by_row_[bin] = rounded_up(high);
}

/// A bin that a triangle meets and no boundary crosses is covered throughout; elsewhere nothing is known of how low the
/// ground is.
void BinnedHeights::forget_depth_at(const Tin& tin, const std::vector<BoundaryEdge>& boundary) {
  std::vector<bool> at_boundary(tin.triangles.size());
  for (const BoundaryEdge& edge : boundary) at_boundary[edge.triangle] = true;
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t r) {
    for (std::int64_t c = 0; c < columns(); ++c) {
      const auto listed = triangles(c, static_cast<std::int64_t>(r));
      if (std::any_of(listed.begin(), listed.end(), [&](std::uint32_t t) { return at_boundary[t]; }))
        low_by_row_[grid_.index({c, static_cast<std::int64_t>(r)})] = -kInfinity;
    }
  });
}

void BinnedHeights::transpose() {
  low_by_column_.resize(grid_.cell_count()), high_by_column_.resize(grid_.cell_count());
  // In strips, so that neither side leaves the cache.
  constexpr std::int64_t kStrip = 32;
  parallel_for(static_cast<std::size_t>((rows() + kStrip - 1) / kStrip), [&](std::size_t strip) {
    const std::int64_t first = static_cast<std::int64_t>(strip) * kStrip, last = std::min(rows(), first + kStrip);
    for (std::int64_t c = 0; c < columns(); ++c) {
      for (std::int64_t r = first; r < last; ++r) {
        const std::size_t to = static_cast<std::size_t>(c * rows() + r), from = grid_.index({c, r});
        low_by_column_[to] = low_by_row_[from], high_by_column_[to] = high_by_row_[from];
      }
    }
  });
}

}  // namespace itin::viewshed
