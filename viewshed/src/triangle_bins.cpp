#include "triangle_bins.hpp"

#include <algorithm>
#include <cmath>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

struct BinRange {
  std::int64_t west, east, north, south;  ///< inclusive; empty when west > east or north > south
};

BinRange range_of(const Tin& tin, const Triangle& t, const RasterGrid& grid) {
  GridBox box;
  for (const std::uint32_t v : t) box.extend(tin.vertices[v].x, tin.vertices[v].y);
  const Box b = tin.grid.box(box);
  // A little more than the box, against rounding.
  constexpr double kSlack = 1e-6;
  const auto clamp = [](double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(std::floor(v), -1.0, static_cast<double>(count)));
  };
  return {std::max<std::int64_t>(0, clamp(grid.column_at(b.xmin) - kSlack, grid.columns())),
          std::min(grid.columns() - 1, clamp(grid.column_at(b.xmax) + kSlack, grid.columns())),
          std::max<std::int64_t>(0, clamp(grid.row_at(b.ymax) - kSlack, grid.rows())),
          std::min(grid.rows() - 1, clamp(grid.row_at(b.ymin) + kSlack, grid.rows()))};
}

}  // namespace

TriangleBins::TriangleBins(const Tin& tin, const RasterGrid& grid) {
  // Chunks of triangles count on their own and then know where to write: ascending numbers, whatever the threads.
  constexpr std::size_t kChunks = 16;
  const std::size_t count = tin.triangles.size(), bins = grid.cell_count();
  std::vector<std::vector<std::uint32_t>> places(kChunks, std::vector<std::uint32_t>(bins));
  const auto for_each_entry = [&](std::size_t chunk, const auto& body) {
    for (std::size_t t = count * chunk / kChunks; t < count * (chunk + 1) / kChunks; ++t) {
      const BinRange range = range_of(tin, tin.triangles[t], grid);
      for (std::int64_t row = range.north; row <= range.south; ++row)
        for (std::int64_t column = range.west; column <= range.east; ++column)
          body(static_cast<std::uint32_t>(t), grid.index({column, row}));
    }
  };
  parallel_for(kChunks, [&](std::size_t chunk) {
    for_each_entry(chunk, [&](std::uint32_t, std::size_t bin) { ++places[chunk][bin]; });
  });
  first_.resize(bins + 1);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    std::uint32_t total = 0;
    for (auto& chunk : places) {
      const std::uint32_t own = chunk[bin];
      chunk[bin] = total;
      total += own;
    }
    first_[bin + 1] = first_[bin] + total;
  }
  triangles_.resize(first_[bins]);
  parallel_for(kChunks, [&](std::size_t chunk) {
    for_each_entry(chunk,
                   [&](std::uint32_t t, std::size_t bin) { triangles_[first_[bin] + places[chunk][bin]++] = t; });
  });
}

}  // namespace itin::viewshed
