#include "bounds/height_pyramid.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"

namespace itin::viewshed {

namespace {

/// Some two triangles' worth a bin; a power of two a side.
RasterGrid grid_of_bins(const Tin& tin) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double size = std::max({box.width(), box.height(), tin.grid.resolution});
  const auto wanted = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(tin.triangles.size()) / 2));
  const double side = std::clamp(std::bit_floor(wanted), 1U, 2048U);
  // A hundredth more than needed, so that the eastern and southern edges lie inside.
  const double bin = size * 1.01 / side;
  return {{box.xmin, box.ymax}, bin, bin, static_cast<std::int64_t>(side), static_cast<std::int64_t>(side)};
}

double reciprocal(double d) {
  return 1 / (d == 0 ? std::numeric_limits<double>::min() : d);
}

}  // namespace

HeightPyramid::HeightPyramid(const Tin& tin)
    : tin_(tin),
      bin_grid_(grid_of_bins(tin)),
      bins_(tin, bin_grid_),
      side_(static_cast<std::uint32_t>(bin_grid_.rows())),
      tops_(tin.triangles.size()),
      grid_(tin.grid) {
  std::transform(tin.triangles.begin(), tin.triangles.end(), tops_.begin(), [&](const Triangle& t) {
    return std::max({tin.vertices[t[0]].z, tin.vertices[t[1]].z, tin.vertices[t[2]].z});
  });
  constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
  std::vector<std::int32_t>& bins = highest_.emplace_back(std::size_t{side_} * side_, kNothing);
  parallel_for(side_, [&](std::size_t row) {
    for (std::size_t b = row * side_; b < (row + 1) * side_; ++b)
      for (const std::uint32_t t : bins_.triangles(b)) bins[b] = std::max(bins[b], tops_[t]);
  });
  for (std::size_t n = side_ / 2; n > 0; n /= 2) {
    std::vector<std::int32_t> coarser(n * n);
    const std::vector<std::int32_t>& finer = highest_.back();
    for (std::size_t i = 0; i < n * n; ++i) {
      const std::size_t first = (i / n * 2) * (2 * n) + i % n * 2;
      coarser[i] = std::max({finer[first], finer[first + 1], finer[first + 2 * n], finer[first + 2 * n + 1]});
    }
    highest_.push_back(std::move(coarser));
  }
}

std::optional<std::uint32_t> HeightPyramid::triangle_at(Point2 units) const {
  const auto bin =
      bin_grid_.cell_at({grid_.origin.x + units.x * grid_.resolution, grid_.origin.y + units.y * grid_.resolution});
  if (!bin) return std::nullopt;
  for (const std::uint32_t t : bins_.triangles(bin_grid_.index(*bin)))
    if (height_over(tin_.corners(t), units)) return t;
  return std::nullopt;
}

HeightPyramid::Track HeightPyramid::track_of(const LineBundle& bundle) const {
  const auto column = [&](double x) { return bin_grid_.column_at(grid_.origin.x + x * grid_.resolution); };
  const auto row = [&](double y) { return bin_grid_.row_at(grid_.origin.y + y * grid_.resolution); };
  const auto side = [](double from, double to) { return Side{from, reciprocal(to - from)}; };
  // Rows count southwards.
  return {side(column(bundle.from_west), column(bundle.to_west)),
          side(column(bundle.from_east), column(bundle.to_east)), side(row(bundle.from_north), row(bundle.to_north)),
          side(row(bundle.from_south), row(bundle.to_south))};
}

}  // namespace itin::viewshed
