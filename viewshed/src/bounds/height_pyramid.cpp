#include "bounds/height_pyramid.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

#include "bounds/surface_heights.hpp"

namespace itin::viewshed {

namespace {

/// Bins for some two triangles each; a power of two per side.
RasterGrid grid_of_bins(const Tin& tin) {
  const auto wanted = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(tin.triangles.size()) / 2));
  return square_bins_over(tin, std::clamp(std::bit_floor(wanted), 1U, 2048U));
}

double reciprocal(double d) {
  return 1 / (d == 0 ? std::numeric_limits<double>::min() : d);
}

}  // namespace

HeightPyramid::HeightPyramid(const Tin& tin, const Progress& progress)
    : tin_(&tin),
      units_(tin.grid),
      bin_grid_(grid_of_bins(tin)),
      listed_(Listed{TriangleBins(tin, bin_grid_, progress), {}}) {
  listed_->tops.resize(tin.triangles.size());
  std::transform(tin.triangles.begin(), tin.triangles.end(), listed_->tops.begin(), [&](const Triangle& t) {
    return std::max({tin.vertices[t[0]].z, tin.vertices[t[1]].z, tin.vertices[t[2]].z});
  });
  std::vector<std::int32_t>& bins = highest_.emplace_back(bin_grid_.cell_count(), kNothing);
  parallel_for(rows(0), [&](std::size_t row) {
    progress.throw_if_cancelled();
    for (std::size_t b = row * columns(0); b < (row + 1) * columns(0); ++b)
      for (const std::uint32_t t : listed_->bins.triangles(b)) bins[b] = std::max(bins[b], listed_->tops[t]);
  });
  build_blocks();
}

HeightPyramid::HeightPyramid(const LatticeTin& lattice)
    : lattice_(&lattice),
      units_(lattice.grid),
      bin_grid_(lattice.grid.position(lattice.west, lattice.north), lattice.spacing * lattice.grid.resolution,
                lattice.spacing * lattice.grid.resolution, lattice.columns, lattice.rows) {
  highest_.emplace_back();
  build_blocks();
}

/// Computes all levels above the bins.
void HeightPyramid::build_blocks() {
  for (std::uint32_t level = 1; columns(level - 1) > 1 || rows(level - 1) > 1; ++level) {
    std::vector<std::int32_t> coarser(std::size_t{columns(level)} * rows(level), kNothing);
    parallel_for(rows(level), [&](std::size_t row) {
      for (std::uint32_t column = 0; column < columns(level); ++column) {
        std::int32_t& top = coarser[row * columns(level) + column];
        const auto south = std::min<std::uint32_t>(static_cast<std::uint32_t>(2 * row + 2), rows(level - 1)),
                   east = std::min(2 * column + 2, columns(level - 1));
        for (auto r = static_cast<std::uint32_t>(2 * row); r < south; ++r)
          for (std::uint32_t c = 2 * column; c < east; ++c) top = std::max(top, highest({level - 1, c, r}));
      }
    });
    highest_.push_back(std::move(coarser));
  }
}

std::optional<std::uint32_t> HeightPyramid::triangle_at(Point2 units) const {
  const auto hit = hit_at(units);
  return hit ? std::optional(hit->triangle) : std::nullopt;
}

std::optional<double> HeightPyramid::height_at(Point2 units) const {
  const auto hit = hit_at(units);
  return hit ? std::optional(hit->height) : std::nullopt;
}

std::optional<HeightPyramid::Hit> HeightPyramid::hit_at(Point2 units) const {
  std::optional<Hit> hit;
  const auto misses = [&](std::uint32_t t) {
    const auto height = height_over(corners(t), units);
    if (height) hit = {t, *height};
    return !height;
  };
  for_each_triangle_near(units, misses);
  return hit;
}

HeightPyramid::Track HeightPyramid::track_of(const LineBundle& bundle) const {
  const auto column = [&](double x) { return bin_grid_.column_at(units_.origin.x + x * units_.resolution); };
  const auto row = [&](double y) { return bin_grid_.row_at(units_.origin.y + y * units_.resolution); };
  const auto side = [](double from, double to) { return Side{from, reciprocal(to - from)}; };
  // Rows count southwards.
  return {side(column(bundle.from_west), column(bundle.to_west)),
          side(column(bundle.from_east), column(bundle.to_east)), side(row(bundle.from_north), row(bundle.to_north)),
          side(row(bundle.from_south), row(bundle.to_south))};
}

}  // namespace itin::viewshed
