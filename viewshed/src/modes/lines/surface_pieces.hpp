// The pieces of a surface along lines: straight over each triangle, as cross-sections have them.
//
//   const SurfacePieces surface(std::make_shared<const HeightPyramid>(tin));
//   std::vector<SurfacePieces::Piece> pieces;
//   surface.along(SectionLine(tin.grid, a, b), pieces);
//
// A walk goes from triangle to triangle, and computes each crossing of an edge once. It follows the line's right side
// where that passes over a vertex or along an edge, so that exactly two edges of a triangle are crossed. Where it comes
// to the surface's edge, a search looks at all triangles that may lie under the line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/diffraction.hpp>
#include <itin/section_line.hpp>
#include <itin/tin.hpp>

#include "bounds/height_pyramid.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class SurfacePieces {
 public:
  /// The surface is a Tin. Takes 12 bytes per triangle.
  explicit SurfacePieces(std::shared_ptr<const HeightPyramid> surface);

  const Grid& grid() const { return surface_->units(); }

  /// The ends of a piece: metres from the line's start (SectionLine::start()), and heights.
  struct Piece {
    PathPoint from, to;
  };
  /// Finds the pieces in order of distance; some have length 0, and some come more than once. Cost: about 40
  /// nanoseconds per triangle, five times that where the line leaves the surface.
  void along(const SectionLine& line, std::vector<Piece>& pieces) const;

  // The two ways of along().
  /// Returns false where the line leaves the surface; then the pieces are those up to there.
  bool walk(const SectionLine& line, std::vector<Piece>& pieces) const;
  void search(const SectionLine& line, std::vector<Piece>& pieces) const;

 private:
  /// A triangle that a line passes through, and the edge by which the line leaves: from corner `exit` to the next.
  struct Stop {
    std::uint32_t triangle = 0;
    std::uint32_t exit = 0;
    SectionCrossing in;  ///< where the line enters
  };
  std::optional<Stop> first_stop(const SectionLine& line) const;
  const GridPoint& corner(std::uint32_t triangle, std::uint32_t i) const {
    return surface_->tin().vertices[surface_->tin().triangles[triangle][i % 3]];
  }

  std::shared_ptr<const HeightPyramid> surface_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;  ///< as adjacent_triangles()
};

}  // namespace itin::viewshed
