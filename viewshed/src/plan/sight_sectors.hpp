// The cells that an eye looks at, taken up sector by sector about it.
//
//   SightSectors sectors(grid, eye);
//   while (!sectors.empty()) {
//     const SightSectors::Sector sector = sectors.next([&](const std::vector<Point2>& hull) { return ...; });
//     const double reach = ...                    // look at all its cells that are not farther away
//     sectors.remove_decided(sector, reach);
//   }
//
// A sector is the hull of the eye and of cells next to each other in azimuth, so that it holds all sight lines to them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>

#include "line/tile_parts.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

class SightSectors {
 public:
  /// Both must outlive this object.
  SightSectors(const RasterGrid& cells, const Eye& eye);

  bool empty() const { return parts_.empty(); }

  struct Sector {
    std::span<const Tile> parts;  ///< boxes of cells, each within one tile of the grid
    std::vector<Point2> hull;     ///< counterclockwise, metres
  };
  using Fits = std::function<bool(const std::vector<Point2>& hull)>;
  /// Returns the widest sector whose hull fits, or else the narrowest. Valid until remove_decided().
  Sector next(const Fits& fits) const;
  /// Tells whether all cells of a part are nearer to the eye than `reach` metres, along columns and rows.
  bool within(double reach, const Tile& part) const;
  /// Removes the sector's parts within that reach, which have been decided. The rest of the sector will come in
  /// narrower ones. Throws InputError where the rest is a single cell.
  void remove_decided(const Sector& sector, double reach);

 private:
  void divide_next();

  const RasterGrid& cells_;
  const Eye& eye_;
  std::vector<Tile> parts_;  ///< the parts that are left, the next one last
  std::size_t most_;         ///< parts of the next sector
};

}  // namespace itin::viewshed
