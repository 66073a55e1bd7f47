// A surface for single lines in great number: how high it is, and which lines it hides, exact whatever else is known
// of it.
//
//   const LineTester surface(retrieved, earth, lines_expected);
//   const unsigned hidden = surface.hidden(lines);   // one bit per line, as SightLine has it
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <viewshed/surface.hpp>

#include "bounds/height_pyramid.hpp"
#include "line/sight_lines.hpp"
#include "scene/rays/scene.hpp"

namespace itin::viewshed {

/// Every triangle that may rise above a line is asked (HeightPyramid). Where a Tin is asked about very many lines, rays
/// find these triangles in less time (Scene).
class LineTester {
 public:
  /// The surface must outlive it and have all its heights; about `lines` lines will be tested. Throws std::bad_alloc.
  LineTester(const RetrievedSurface& surface, const Earth& earth, std::uint64_t lines);
  /// About how many bytes a Tin of `points` points takes. A lattice takes kBytesPerPost per post.
  static std::uint64_t bytes(std::uint64_t points, std::uint64_t lines);

  const Grid& units() const { return pyramid_.units(); }
  /// The height at a position, both in grid units.
  std::optional<double> height(Point2 units) const { return pyramid_.height_at(units); }
  /// The edges where the surface ends.
  std::vector<RimEdge> rim() const;

  /// Returns one bit per line: 1 if it is hidden. Ends of active lines differ horizontally. Safe for concurrent use.
  unsigned hidden(const SightLines& lines) const;

 private:
  bool hidden(const Point3& from, const Point3& to) const;

  const RetrievedSurface& surface_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
  HeightPyramid pyramid_;
  std::optional<Scene> rays_;
};

}  // namespace itin::viewshed
