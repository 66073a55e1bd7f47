#include "bounds/triangle_bins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <itin/parallel.hpp>

#include "bounds/triangle_in_bins.hpp"

namespace itin::viewshed {

namespace {

/// After so many triangles it is looked whether the call is cancelled.
constexpr std::size_t kTrianglesPerLook = 1024;

}  // namespace

RasterGrid square_bins_over(const Tin& tin, double side) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double size = std::max({box.width(), box.height(), tin.grid.resolution});
  // A hundredth more than needed, so that the eastern and southern edges lie inside.
  const double bin = size * 1.01 / side;
  return {{box.xmin, box.ymax}, bin, bin, static_cast<std::int64_t>(side), static_cast<std::int64_t>(side)};
}

RasterGrid location_grid(const Tin& tin) {
  return square_bins_over(tin, std::clamp(std::floor(std::sqrt(tin.triangles.size())), 1.0, 512.0));
}

TriangleBins::TriangleBins(const Tin& tin, const RasterGrid& grid, const Progress& progress) {
  const std::size_t count = tin.triangles.size(), bins = grid.cell_count();
  const VerticesInBins vertices(tin, grid);
  const auto for_each_bin = [&](std::size_t t, const auto& visit) {
    const TriangleInBins triangle(vertices, tin.triangles[t]);
    const BinRange& box = triangle.box();
    for (std::int64_t row = box.north; row <= box.south; ++row) {
      auto [west, east] = std::pair{box.west, box.east};
      if (!triangle.fills_box()) std::tie(west, east) = triangle.columns_in(row);
      for (std::int64_t column = west; column <= east; ++column) visit(grid.index({column, row}));
    }
  };
  // Each chunk of triangles counts its entries first, and so knows where to write them: by ascending number, whatever
  // the number of threads.
  const auto chunks = static_cast<std::size_t>(std::min(16, thread_count()));
  std::vector<std::vector<std::uint32_t>> places(chunks, std::vector<std::uint32_t>(bins));
  const auto for_each_entry = [&](std::size_t chunk, const auto& body) {
    for (std::size_t t = count * chunk / chunks; t < count * (chunk + 1) / chunks; ++t) {
      if (t % kTrianglesPerLook == 0) progress.throw_if_cancelled();
      for_each_bin(t, [&](std::size_t bin) { body(static_cast<std::uint32_t>(t), bin); });
    }
  };
  parallel_for(chunks, [&](std::size_t chunk) {
    for_each_entry(chunk, [&](std::uint32_t, std::size_t bin) { ++places[chunk][bin]; });
  });
  first_.resize(bins + 1);
  std::uint64_t entries = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    std::uint32_t total = 0;
    for (auto& chunk : places) {
      const std::uint32_t own = chunk[bin];
      chunk[bin] = total;
      total += own;
    }
    entries += total;
    if (entries > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("too many triangles to bin");
    first_[bin + 1] = static_cast<std::uint32_t>(entries);
  }
  triangles_.resize(first_[bins]);
  parallel_for(chunks, [&](std::size_t chunk) {
    for_each_entry(chunk,
                   [&](std::uint32_t t, std::size_t bin) { triangles_[first_[bin] + places[chunk][bin]++] = t; });
  });
}

}  // namespace itin::viewshed
