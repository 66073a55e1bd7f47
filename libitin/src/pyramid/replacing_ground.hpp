// The ground of sources that take the place of others, as an area: lines of the others end at its border.
#pragma once

#include <utility>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/polygon_sides.hpp"
#include "pyramid/sorted_points.hpp"

namespace itin {

class ReplacingGround {
 public:
  /// The coverage (coverage.hpp) of these points: those of all sources that replace, and no others.
  ReplacingGround(SortedPoints points, const std::vector<SourceInfo>& sources, const Grid& grid, Progress& progress);

  using Piece = std::pair<GridPoint, GridPoint>;
  /// The pieces of a line from a to b that lie outside, in order; the line itself where none of it lies inside. Ends at
  /// the border are rounded to the grid, and their heights are those of the line.
  std::vector<Piece> outside(const GridPoint& a, const GridPoint& b) const;

 private:
  PolygonSides area_;
};

}  // namespace itin
