// Which parts of a line have ground under them, from the coverage outline alone.
//
// To a walk a vertex on the line is left of it or right of it, as `OnLine` says; then no vertex is on the line and
// every edge it meets it crosses. That moves the line by an infinitesimal to one side. Where the line runs along the
// outline, or touches it at a vertex, one side has ground and the other not: a point has ground when either has
// (GroundRuns:: touches says whether that is worth asking).
#pragma once

#include <optional>
#include <vector>

#include <itin/section_line.hpp>

#include "geometry/predicates.hpp"
#include "store/point_index.hpp"

namespace itin {

enum class OnLine { kLeft, kRight };

/// Whether a vertex that is on this side of the line (SectionLine::side()) counts as left of it.
inline bool counts_as_left(Int128 side, OnLine on_line) {
  return side > 0 || (side == 0 && on_line == OnLine::kLeft);
}

/// A segment of the outline that the line crosses, by its ends left and right of the line.
struct OutlineCrossing {
  Position left;
  Position right;
};

/// From where the line enters the ground (or from its start) to where it leaves it (or its end).
struct GroundRun {
  std::optional<OutlineCrossing> entry;
  std::optional<OutlineCrossing> exit;
};

struct GroundRuns {
  /// In order. The first has no entry where the line is not known to start outside the ground: it may do so even
  /// then, if it has no exit either.
  std::vector<GroundRun> runs;
  bool touches = false;  ///< an end of one of the segments met is on the line
};

/// Throws Error where the outline is not closed.
GroundRuns ground_runs(const PointIndex& index, const SectionLine& line, OnLine on_line);

}  // namespace itin
