// Cells of segments as cells of a result of the whole request: at their places, with the numbers that observers and
// blockers have there.
//
//   SegmentCells cells(whole);
//   cells.add(segment, part, segment.north_west);   // one segment after the other
//   cells.finish();
#pragma once

#include <viewshed/plan.hpp>

#include "modes/blocker_table.hpp"

namespace itin::viewshed {

class SegmentCells {
 public:
  /// Prepares the cells of `to`, of which request and grid are known: all are outside. `to` must outlive this.
  explicit SegmentCells(Result& to);

  /// Copies the cells of a segment's result, the first to this place.
  void add(const Segment& segment, const Result& part, RasterGrid::Cell at);
  /// Gives the result the blockers that its cells name.
  void finish();

 private:
  Result& to_;
  BlockerTable blockers_;
};

}  // namespace itin::viewshed
