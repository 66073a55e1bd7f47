// The walk along a line from triangle to triangle, with any way of finding the triangles.
#pragma once

#include <array>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/section_line.hpp>

#include "cross_section/ground_runs.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// A vertex of the triangulation, and the theme of the raised feature that it is part of, off the feature's outline.
struct SectionVertex : GridPoint {
  std::uint16_t theme = 0;  ///< 0: none
};

/// An edge that the line crosses, by its ends left and right of the line.
struct CrossedEdge {
  SectionVertex left;
  SectionVertex right;
};

/// Finds the ground's triangles, one after another. Serves one line.
class TriangleFinder {
 public:
  virtual ~TriangleFinder() = default;
  /// Returns the third vertex of the ground triangle ahead of an edge. Precondition: there is one.
  virtual SectionVertex beyond(const CrossedEdge& edge) = 0;
  /// Returns ground triangles, among them all that meet the box, which is at most one grid step wide; counterclockwise.
  virtual std::vector<std::array<SectionVertex, 3>> around(const GridBox& box) = 0;
  /// Returns the edge of the triangulation at which the line crosses a segment of the outline.
  virtual CrossedEdge edge_on(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line) = 0;
};

/// Returns the line's direction, of length 1; any direction where the line has none.
Point2 heading_of(const SectionLine& line);

/// Returns the cross-section without its retrieval statistics, in the direction in which the line's ends were given.
CrossSection walk_section(const PointIndex& index, const SectionLine& line, TriangleFinder& triangles);

/// Finds the CrossedEdge on a segment by reading the vertices around the crossing. Counts what it reads.
CrossedEdge find_edge_on(const PointIndex& index, const Selection& selection, const OutlineCrossing& segment,
                         const SectionLine& line, OnLine on_line, RetrievalStatistics& statistics);

}  // namespace itin
