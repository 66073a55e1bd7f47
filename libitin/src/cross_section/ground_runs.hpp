// The parts of a line that have ground under them, from the coverage outline alone.
//
// A walk counts a vertex on the line as left or right of it, as `OnLine` says. Then no vertex is on the line, and the
// line crosses every edge that it meets: it is moved by an infinitesimal to one side. Where the line runs along the
// outline, or touches it at a vertex, one side has ground and the other has none. A point has ground when either side
// has (GroundRuns::touches says whether asking for both is worth while).
#pragma once

#include <optional>
#include <vector>

#include <itin/section_line.hpp>

#include "geometry/predicates.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

enum class OnLine { kLeft, kRight };

/// Tells whether a vertex on this side of the line (SectionLine::side()) counts as left of it.
inline bool counts_as_left(Int128 side, OnLine on_line) {
  return side > 0 || (side == 0 && on_line == OnLine::kLeft);
}

/// A segment of the outline that the line crosses, by its ends left and right of the line.
struct OutlineCrossing {
  Position left;
  Position right;
};

/// A run of ground, from where the line enters it (or from the line's start) to where the line leaves it (or ends).
struct GroundRun {
  std::optional<OutlineCrossing> entry;
  std::optional<OutlineCrossing> exit;
};

struct GroundRuns {
  /// The runs in order. The first has no entry unless the line is known to start outside the ground. If it has no exit
  /// either, the line may still lie outside the ground.
  std::vector<GroundRun> runs;
  bool touches = false;  ///< an end of one of the segments met is on the line
};

/// Finds the runs of a line. Throws Error where the outline is not closed.
GroundRuns ground_runs(const PointIndex& index, const SectionLine& line, OnLine on_line);

}  // namespace itin
