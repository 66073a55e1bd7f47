// Divides a raster into windows to read, so that memory follows neither its size nor that of its blocks.
//
//   const RasterWindows windows(band, memory_bytes);
//   windows.require_small_blocks(dataset);
//   windows.for_each([&](const RasterWindow& window) { band.read(window, heights); ... });
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "import/source/height_band.hpp"

class GDALDataset;

namespace itin {

class RasterWindows {
 public:
  /// `memory_bytes` is the memory of the whole import, of which reading takes a part. The band must outlive it.
  RasterWindows(const HeightBand& band, std::uint64_t memory_bytes);

  /// Throws InputError where the raster, or one that it is made of, is stored in blocks that each take more than a
  /// quarter of the memory.
  void require_small_blocks(GDALDataset& dataset) const;

  /// Visits windows row by row, in whole blocks where they fit. Parts that the file holds nothing of, so that all of
  /// their posts would be read as nodata, are left out as a whole, however large. Returns how many posts are left out.
  std::uint64_t for_each(const std::function<void(const RasterWindow&)>& visit) const;

  /// Returns the part outside of which a vast raster holds nothing; for any other raster, the whole. Throws InputError
  /// where the raster has more posts than a store holds, and does not say that most of them are absent.
  static RasterWindow present(const HeightBand& band);

 private:
  /// Places of windows among all: columns and rows of windows, not of posts.
  using Places = RasterWindow;
  RasterWindow posts_of(const Places& places) const;
  bool absent(const Places& places) const;
  std::uint64_t visit_rows(const Places& places, const std::function<void(const RasterWindow&)>& visit) const;
  std::uint64_t visit_columns(const Places& places, const std::function<void(const RasterWindow&)>& visit) const;

  const HeightBand& band_;
  std::uint64_t memory_bytes_;
  int columns_ = 1, rows_ = 1;  ///< number of columns and rows of a window
  bool tells_absence_ = false;
};

}  // namespace itin
