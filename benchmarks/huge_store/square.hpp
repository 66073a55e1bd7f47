// The ground of a fractal store: a square of posts 1 m apart, on the grid that an importer would choose for it.
#pragma once

#include <cstdint>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "huge_store/posts.hpp"

namespace itin::huge {

class Square {
 public:
  static constexpr const char* kCrs = "EPSG:32630";
  static constexpr std::int32_t kSpacing = 100;  ///< grid units
  static constexpr Grid kGrid{{0, 5368709.12}, 0.01};
  static constexpr std::int32_t kUnitsPerDecimetre = 10;

  /// The square's south-western corner is at 400,000 east, 6,000,000 north. Precondition: its side is 1 to 100,000 m.
  explicit Square(std::int32_t side_m)
      : ground_{kWest, kSouth, kWest + side_m * kSpacing, kSouth + side_m * kSpacing} {}

  const GridBox& ground() const { return ground_; }
  bool meets(const Cell& cell) const { return ground_.meets(cell.box()); }

  /// The posts of a stage that the cell holds.
  PostBox within(const Cell& cell, int stage) const {
    const GridBox box = intersection(cell.box(), ground_);
    if (box.empty()) return {};
    const std::int32_t spacing = kSpacing << stage;
    const auto range = [&](std::int32_t low, std::int32_t high) {
      return PostRange{(low + spacing - 1) / spacing, high / spacing};
    };
    return {range(box.xmin - kWest, box.xmax - kWest), range(box.ymin - kSouth, box.ymax - kSouth)};
  }
  /// The corners of all triangles of a stage that meet the cell's square. Precondition: the cell meets the ground.
  PostBox about(const Cell& cell, int stage) const {
    const GridBox box = intersection(square_of(cell), ground_);
    const std::int32_t spacing = kSpacing << stage;
    const auto range = [&](std::int32_t low, std::int32_t high) {
      return PostRange{low / spacing, (high + spacing - 1) / spacing};
    };
    return {range(box.xmin - kWest, box.xmax - kWest), range(box.ymin - kSouth, box.ymax - kSouth)};
  }

  GridPoint post(int stage, std::int32_t column, std::int32_t row, std::int32_t decimetres) const {
    const std::int32_t spacing = kSpacing << stage;
    return {kWest + column * spacing, kSouth + row * spacing, decimetres * kUnitsPerDecimetre};
  }

 private:
  static constexpr std::int32_t kWest = 40'000'000, kSouth = 63'129'088;

  GridBox ground_;
};

}  // namespace itin::huge
