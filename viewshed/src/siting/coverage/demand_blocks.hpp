// Cells of a raster as elements of a demand: blocks of eight by eight cells.
#pragma once

#include <cstdint>

#include <itin/raster.hpp>

namespace itin::viewshed {

class DemandBlocks {
 public:
  static constexpr std::int64_t kSide = 8;

  explicit DemandBlocks(const RasterGrid& grid)
      : columns_((grid.columns() + kSide - 1) / kSide), rows_((grid.rows() + kSide - 1) / kSide) {}

  std::size_t count() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::size_t element_count() const { return 64 * count(); }
  std::uint32_t block(RasterGrid::Cell cell) const {
    return static_cast<std::uint32_t>(cell.row / kSide * columns_ + cell.column / kSide);
  }
  static unsigned bit(RasterGrid::Cell cell) {
    return static_cast<unsigned>(cell.row % kSide * kSide + cell.column % kSide);
  }
  std::size_t element(RasterGrid::Cell cell) const { return std::size_t{64} * block(cell) + bit(cell); }
  /// Returns an element's cell; it lies outside the grid for elements that are padding.
  RasterGrid::Cell cell(std::size_t element) const {
    const auto b = static_cast<std::int64_t>(element / 64), i = static_cast<std::int64_t>(element % 64);
    return {b % columns_ * kSide + i % kSide, b / columns_ * kSide + i / kSide};
  }

 private:
  std::int64_t columns_, rows_;
};

}  // namespace itin::viewshed
