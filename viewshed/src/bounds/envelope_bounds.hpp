// How low and how high a surface is within bins, told by two other surfaces that enclose it, such as a coarse level and
// its certificate. Bins may be far smaller than the triangles of these surfaces, so that the bounds follow their
// slopes.
//
//   const EnvelopeBounds bounds(lower, upper, outline, box, bin);
//   if (bounds.covers(box)) ...                      // there is ground all over the box
//   bounds.highest(box)                              // grid units
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <itin/tin.hpp>

#include "bounds/bin_bounds.hpp"
#include "bounds/boundary.hpp"
#include "bounds/triangle_bins.hpp"
#include "bounds/triangle_in_bins.hpp"

namespace itin::viewshed {

/// The side, metres, of bins within a box that follow the slopes of a level's triangles: many bins per triangle, but no
/// more in all than take a moment.
double side_of_bins(const Tin& level, const Box& box);

class EnvelopeBounds final : public BinBounds {
 public:
  /// Bounds the surface within a box, metres. Both surfaces have the same triangles; `outline` is where the ground
  /// ends. Triangles may overlap: then all of their bounds count. `bin` is the side of a bin, metres. Memory: 16 bytes
  /// per bin.
  EnvelopeBounds(const Tin& lower, const Tin& upper, const std::vector<BoundaryEdge>& outline, const Box& box,
                 double bin);

  /// The greatest height within a box, grid units; -infinity where there is no ground.
  float highest(const BinBox& box) const;
  /// Whether there is ground everywhere in a box; false where the outline passes near.
  bool covers(const BinBox& box) const;

 private:
  double slack() const;
  void bound(const Tin& lower, const Tin& upper);
  void bound_triangle(const Tin& lower, const Tin& upper, const VerticesInBins& vertices, std::uint32_t triangle,
                      const BinRange& within);
  void lower_along_outline(const Tin& tin, const std::vector<BoundaryEdge>& outline);
  void round_outwards();
  void bound_runs();

  std::vector<float> low_, high_;  ///< one entry for each bin
};

}  // namespace itin::viewshed
