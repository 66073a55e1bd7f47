// Makes lines planar: what comes out meets only at vertices, whatever went in.
//
//   std::vector<OwnedSegment> pieces = ...;            // all lines of all owners, in any order
//   PlanarLines lines = make_planar(pieces);
//   for (const PlanarEdge& e : lines.edges) ...        // e.from, e.to: numbers in lines.vertices
//
// Snap rounding on the grid (J. D. Hobby, Practical segment intersection with finite precision output, 1999): every
// pixel that holds an end or a crossing is hot, and a segment is led through the centres of all hot pixels it meets. So
// no segment moves by more than half a grid step in x or y, crossings get one vertex, T-junctions, collinear overlaps,
// duplicates and segments without length need no case of their own, and the result depends on the set of segments
// alone. Everything is decided in integers. Lines that are planar already may be moved again, for a segment may have
// been led past a vertex at less than half a step.
//
// Heights. A vertex takes the height of the owner that comes first in order. Where this owner gives several, the height
// of a segment's end goes before one interpolated along a segment, and then the greatest counts.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

#include "store/segments/segment_features.hpp"

namespace itin {

/// A piece of a line. Owners (themes, for example) are numbered in the order in which they decide about heights.
/// `feature` is a feature of the owner, or kNoFeature.
struct OwnedSegment {
  GridPoint a, b;
  std::uint32_t owner = 0;
  std::uint32_t feature = kNoFeature;
  friend auto operator<=>(const OwnedSegment&, const OwnedSegment&) = default;
};

struct PlanarEdge {
  std::uint32_t from, to;  ///< from < to
  std::uint32_t owner;
  friend auto operator<=>(const PlanarEdge&, const PlanarEdge&) = default;
};

/// An edge, by its number, and a feature of its owner that it is part of.
struct EdgeFeature {
  std::uint32_t edge, feature;
  friend auto operator<=>(const EdgeFeature&, const EdgeFeature&) = default;
};

struct PlanarLines {
  std::vector<GridPoint> vertices;    ///< in Morton order, distinct, each an end of an edge
  std::vector<PlanarEdge> edges;      ///< ascending; an edge that several owners share is listed for each
  std::vector<EdgeFeature> features;  ///< ascending
  std::uint64_t crossings = 0;        ///< pairs of segments that crossed between their ends
};

/// O((n + k) log n) for n segments and k crossings, as long as segments are not much denser than 64 in 256 grid steps.
/// Throws Cancelled where a progress is given and cancelled.
PlanarLines make_planar(std::vector<OwnedSegment> segments, const Progress* progress = nullptr);

}  // namespace itin
