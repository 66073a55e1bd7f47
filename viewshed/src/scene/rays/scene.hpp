// Sight lines against a Tin: Embree finds triangles that may hide, double precision decides whether they do.
//
//   Scene scene(tin, earth);
//   SightLines lines;                       // up to 16, as close together as possible
//   Occluder occluder;                      // kept from packet to packet
//   unsigned hidden = scene.hidden(lines, occluder);  // one bit per line
//
// Accuracy. Rays are cast in single precision about the Tin's centre with both ends raised by
//     e(l) = sag + u (4 Z + 16 l),    u = 2^-24,
// l the line's length in three dimensions, Z the greatest height in the scene about its centre, sag = kSag where
// curvature is on. This covers the chords' sag, the rounding of heights (u Z each at a vertex and at both ends), and
// Embree's arithmetic, which takes vertices relative to the ray's origin and multiplies three such numbers: 16
// roundings bound each of its edge functions. The triangle that a raised ray goes through must then rise above the line
// itself, which SightLine verifies in double precision, with the curvature exact inside the triangle. Where it does not
// (the ray ran along an edge, and Embree took the neighbour), the line is decided against every triangle under it. So
// - a line reported hidden is hidden, on every processor and however the scene was built;
// - a line reported visible has a clearance above -2 e(l), unless it passes a steep side's silhouette within
//   delta(l) = u (4 X + 16 l), X the greatest coordinate about the centre: beside ground of slope S the clearance is
//   above -2 (e + S delta).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

#include "line/sight_line.hpp"
#include "line/sight_lines.hpp"

namespace itin::viewshed {

/// The triangle that hid the last line: it most often hides the next lines, too.
struct Occluder {
  std::optional<std::uint32_t> triangle;
};

class Scene {
 public:
  /// The Tin must outlive the scene. Throws std::bad_alloc.
  Scene(const Tin& tin, const Earth& earth);
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Returns one bit per line: 1 if it is hidden. Only bits of active lines are set. May be called from any number of
  /// threads, each with its own occluder.
  unsigned hidden(const SightLines& lines, Occluder& occluder) const;
  /// Returns one bit for each four lines, which must be all active or all not: 1 where one triangle hides all four. It
  /// then also hides whatever lies at or below the convex hull of their ends. For what a convex body hides from a point
  /// is convex, and with heights less the drop at their distance lines are straight and the ground under a triangle is
  /// convex. (Where refraction bends lines more than the Earth does, the ground is not convex, and no bit is set.)
  unsigned hidden_together(const SightLines& lines, Occluder& occluder) const;
  /// Tells whether the part of a line between two fractions of its length is hidden, decided in double precision by
  /// every triangle thereabouts. Cost: the triangles under that part.
  bool hidden_between(const SightLines& lines, unsigned line, double from, double to) const;
  /// Height of the surface in metres, if there is any at that position.
  std::optional<double> ground(Point2 position) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
