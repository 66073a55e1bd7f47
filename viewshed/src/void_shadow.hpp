// What lies behind ground without data as an eye sees it: beyond an edge where the surface begins anew.
//
//   const VoidShadow shadow(tin, boundary_edges(tin), eye.units);
//   if (shadow.holds(target)) ...                       // hidden under NoData::kBlock
#pragma once

#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/tin.hpp>

#include "boundary.hpp"
#include "surface_heights.hpp"

namespace itin::viewshed {

class VoidShadow {
 public:
  /// The Tin must outlive it. Grid units. Cost: the edges that face away from the eye, each as often as the sectors of
  /// the horizon it spans.
  VoidShadow(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Point3& eye);

  /// Whether the line from the eye to a place comes back to the surface by crossing_back(). Cost: the edges of one
  /// sector.
  bool holds(double x, double y) const;

  /// Of a tile's cells, what is kCertainlyVisible and lies in it becomes kCertainlyHidden.
  void hide(const TileCentres& centres, TileValues<std::uint8_t>& values) const;

 private:
  std::size_t sector_of(double x, double y) const;

  const Tin& tin_;
  Point3 eye_;
  std::vector<std::vector<BoundaryEdge>> sectors_;  ///< clockwise from the south; empty where no edge faces away
};

}  // namespace itin::viewshed
