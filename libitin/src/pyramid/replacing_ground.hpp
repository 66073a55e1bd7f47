// The ground of sources that take the place of others, as an area: lines of the others end at its border.
#pragma once

#include <utility>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/plan/polygon_sides.hpp"
#include "pyramid/points/sorted_points.hpp"

namespace itin {

class ReplacingGround {
 public:
  /// Finds the coverage (coverage.hpp) of these points: the points of all sources that replace, and no others.
  ReplacingGround(SortedPoints points, const std::vector<SourceInfo>& sources, const Grid& grid, Progress& progress);

  using Piece = std::pair<GridPoint, GridPoint>;
  /// Returns the pieces of a line from a to b that lie outside, in order; the line itself where none of it lies inside.
  /// Ends at the border are rounded to the grid, and take their heights from the line.
  std::vector<Piece> outside(const GridPoint& a, const GridPoint& b) const;

 private:
  PolygonSides area_;
};

}  // namespace itin
