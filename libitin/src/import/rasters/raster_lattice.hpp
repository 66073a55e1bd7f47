// Tells where the posts of a raster lie.
#pragma once

#include <string>

#include <itin/geometry.hpp>

#include "import/source/height_band.hpp"

class GDALDataset;

namespace itin {

/// The lattice of a raster's posts. Post (column, row) lies at origin + column u + row v, in the raster's own CRS.
struct RasterLattice {
  int columns = 0, rows = 0;
  Point2 origin, u, v;

  Point2 post(double column, double row) const {
    return {origin.x + column * u.x + row * v.x, origin.y + column * u.y + row * v.y};
  }
  Box box(const RasterWindow& part) const {
    Box box;
    for (const int column : {part.column, part.column + part.columns - 1})
      for (const int row : {part.row, part.row + part.rows - 1}) box.extend(post(column, row));
    return box;
  }
};

/// Reads the lattice. Throws InputError where the raster has no georeference.
RasterLattice lattice_of(GDALDataset& dataset, const std::string& path);

}  // namespace itin
