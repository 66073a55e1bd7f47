// A raster that comes in parts, in any order, and is never in memory as a whole.
//
//   RasterInParts<float> raster("heights.tif", grid, description);
//   for (const Part& part : parts) raster.write(part.north_west, part.columns, part.rows, part.values);
//   raster.finish(progress);
//
// The parts go into a file beside, as large as the raster is without compression, which is read again at the end.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <itin/progress.hpp>
#include <itin/raster.hpp>

namespace itin {

/// T is std::uint8_t, std::uint16_t, std::uint32_t or float. Not safe for concurrent use.
template <class T>
class RasterInParts {
 public:
  /// Cells that no part has get the description's nodata, or 0 without one. Throws FileError as write_raster() does.
  RasterInParts(const std::string& path, const RasterGrid& grid, const RasterDescription& description);
  /// Removes what was written, unless it was finished.
  ~RasterInParts();

  /// Takes the values of a rectangle of cells, one band after the other. Throws FileError.
  void write(RasterGrid::Cell north_west, std::int64_t columns, std::int64_t rows, std::span<const T> values);
  /// Writes the file, with the bytes that write_raster() gives it. Throws FileError, Cancelled.
  void finish(const Progress& progress = NoProgress());

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

/// Writes the raster of what holds its cells in memory or, where it has `parts`, has them part by part: the values that
/// values_of(part), a vector of T, returns for each, one band after the other. Throws FileError, Cancelled.
template <class T, class Whole, class ValuesOf>
void write_raster_of(const std::string& path, const Whole& whole, const ValuesOf& values_of,
                     const RasterDescription& description, const Progress& progress = NoProgress()) {
  if (!whole.parts) {
    const auto& values = values_of(whole);
    return write_raster(path, whole.grid, std::span<const T>(values), description, progress);
  }
  RasterInParts<T> raster(path, whole.grid, description);
  whole.parts->for_each([&](const Whole& part, RasterGrid::Cell north_west) {
    progress.throw_if_cancelled();
    const auto& values = values_of(part);
    raster.write(north_west, part.grid.columns(), part.grid.rows(), values);
  });
  raster.finish(progress);
}

}  // namespace itin
