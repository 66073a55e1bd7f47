#include "bounds/triangle_bins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

struct BinRange {
  std::int64_t west, east, north, south;  ///< inclusive; empty when west > east or north > south
};

/// A little more than the triangle, against rounding; bins.
constexpr double kSlack = 1e-6;

class TriangleInBins {
 public:
  TriangleInBins(const Tin& tin, const Triangle& t, const RasterGrid& grid) : columns_(grid.columns()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 p = tin.point(t[i]);
      corners_[i] = {grid.column_at(p.x), grid.row_at(p.y)};
    }
    const auto [north, south] =
        std::minmax_element(corners_.begin(), corners_.end(), [](Point2 a, Point2 b) { return a.y < b.y; });
    const auto [west, east] =
        std::minmax_element(corners_.begin(), corners_.end(), [](Point2 a, Point2 b) { return a.x < b.x; });
    box_ = {bin(west->x - kSlack, columns_), bin(east->x + kSlack, columns_), bin(north->y - kSlack, grid.rows()),
            bin(south->y + kSlack, grid.rows())};
    box_.west = std::max<std::int64_t>(0, box_.west), box_.east = std::min(box_.east, columns_ - 1);
    box_.north = std::max<std::int64_t>(0, box_.north), box_.south = std::min(box_.south, grid.rows() - 1);
  }

  const BinRange& box() const { return box_; }
  /// Most triangles meet nearly all of a small box; a long thin one across many bins only those along it.
  bool fills_box() const { return box_.east - box_.west < 3 || box_.south - box_.north < 3; }

  /// The columns that the triangle meets within a row: inclusive.
  std::pair<std::int64_t, std::int64_t> columns_in(std::int64_t row) const {
    const double top = static_cast<double>(row) - kSlack, bottom = static_cast<double>(row + 1) + kSlack;
    double west = std::numeric_limits<double>::infinity(), east = -west;
    const auto extend = [&](double x) { west = std::min(west, x), east = std::max(east, x); };
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 a = corners_[i], b = corners_[(i + 1) % 3];
      if (a.y >= top && a.y <= bottom) extend(a.x);
      for (const double y : {top, bottom})
        if ((a.y < y) != (b.y < y)) extend(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    return {std::max(box_.west, bin(west - kSlack, columns_)), std::min(box_.east, bin(east + kSlack, columns_))};
  }

 private:
  static std::int64_t bin(double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(std::floor(v), -1.0, static_cast<double>(count)));
  }

  std::array<Point2, 3> corners_;
  std::int64_t columns_;
  BinRange box_{};
};

}  // namespace

RasterGrid location_grid(const Tin& tin) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double size = std::max({box.width(), box.height(), tin.grid.resolution});
  const double side = std::clamp(std::floor(std::sqrt(tin.triangles.size())), 1.0, 512.0);
  // A hundredth more than needed, so that the eastern and southern edges lie inside.
  const double bin = size * 1.01 / side;
  return {{box.xmin, box.ymax}, bin, bin, static_cast<std::int64_t>(side), static_cast<std::int64_t>(side)};
}

TriangleBins::TriangleBins(const Tin& tin, const RasterGrid& grid) {
  const std::size_t count = tin.triangles.size(), bins = grid.cell_count();
  const auto for_each_bin = [&](std::size_t t, const auto& visit) {
    const TriangleInBins triangle(tin, tin.triangles[t], grid);
    const BinRange& box = triangle.box();
    for (std::int64_t row = box.north; row <= box.south; ++row) {
      auto [west, east] = std::pair{box.west, box.east};
      if (!triangle.fills_box()) std::tie(west, east) = triangle.columns_in(row);
      for (std::int64_t column = west; column <= east; ++column) visit(grid.index({column, row}));
    }
  };
  // Chunks of triangles count on their own and then know where to write: ascending numbers, whatever the threads.
  const auto chunks = static_cast<std::size_t>(std::min(16, thread_count()));
  std::vector<std::vector<std::uint32_t>> places(chunks, std::vector<std::uint32_t>(bins));
  const auto for_each_entry = [&](std::size_t chunk, const auto& body) {
    for (std::size_t t = count * chunk / chunks; t < count * (chunk + 1) / chunks; ++t)
      for_each_bin(t, [&](std::size_t bin) { body(static_cast<std::uint32_t>(t), bin); });
  };
  parallel_for(chunks, [&](std::size_t chunk) {
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
  parallel_for(chunks, [&](std::size_t chunk) {
    for_each_entry(chunk,
                   [&](std::uint32_t t, std::size_t bin) { triangles_[first_[bin] + places[chunk][bin]++] = t; });
  });
}

}  // namespace itin::viewshed
