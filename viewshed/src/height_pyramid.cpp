#include "height_pyramid.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

/// Some two triangles' worth a bin; a power of two a side.
RasterGrid bin_grid(const Tin& tin) {
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
    : tin_(tin), bin_grid_(bin_grid(tin)), bins_(tin, bin_grid_), side_(static_cast<std::uint32_t>(bin_grid_.rows())) {
  constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
  std::vector<std::int32_t>& bins = highest_.emplace_back(std::size_t{side_} * side_, kNothing);
  parallel_for(side_, [&](std::size_t row) {
    for (std::size_t b = row * side_; b < (row + 1) * side_; ++b)
      for (const std::uint32_t t : bins_.triangles(b)) bins[b] = std::max(bins[b], highest(tin.triangles[t]));
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

HeightPyramid::Track HeightPyramid::track_of(const SightLine& line) const {
  const Grid& grid = tin_.grid;
  const double bins_per_unit = grid.resolution / bin_grid_.cell_width();
  return {bin_grid_.column_at(grid.origin.x + line.from().x * grid.resolution),
          bin_grid_.row_at(grid.origin.y + line.from().y * grid.resolution), reciprocal(line.dx() * bins_per_unit),
          reciprocal(-line.dy() * bins_per_unit)};
}

}  // namespace itin::viewshed
