// Heights of footprints by a digital surface model over the terrain of a store.
//
//   const SurfaceHeights surface({.path = "dsm.tif", .percentile = 90}, store, progress);
//   surface.complete(file, progress);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "import/footprints/footprint_reader.hpp"
#include "import/source/vertical_datums.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

struct SurfaceHeightsQuery {
  std::string path;                  ///< a raster of elevations in the CRS of the store
  double percentile = 50;            ///< which of the cells within a footprint counts, 0 to 100; 50: the median
  VerticalDatums* datums = nullptr;  ///< elevations must share their datum; null: they need not
  std::uint64_t memory_bytes = 0;
};

class SurfaceHeights {
 public:
  /// Reads the raster; the store must outlive this. Throws as read_height_raster() does, and InputError for a
  /// percentile out of range.
  SurfaceHeights(const SurfaceHeightsQuery& query, const Store& store, Progress& progress);

  /// Gives features without height and eaves the percentile of the cells whose centres lie within them; of a feature
  /// without such a cell those under its corners count. A building gets the base that its rule takes from the terrain
  /// under the same cells, unless it has one, so that its roof is at the percentile of their elevations. Everything
  /// else stands by the percentile of their heights above the terrain. Features without data or ground, or that would
  /// not rise above it, stay as they are; a warning counts them. Throws Cancelled, CorruptStore, FileError.
  void complete(FootprintSource& source, Progress& progress) const;

 private:
  struct Cell {
    Point2 centre;
    double elevation = 0;
  };
  std::vector<Cell> cells_of(const FootprintFeature& feature) const;
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const;

  SurfaceHeightsQuery query_;
  const Store& store_;
  std::vector<std::string> warnings_;  ///< about the raster
  HeightCells lattice_;                ///< where cells are
  /// The parts of the raster by row and column of parts; those without data are missing.
  std::vector<std::vector<HeightCells>> parts_;
};

}  // namespace itin
