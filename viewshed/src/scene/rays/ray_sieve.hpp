// What a triangle does to the rays of a packet, in single precision: which it certainly does not hide, and which it
// certainly hides. Only the others have to be decided in double precision.
//
//   const RaySieve sieve = ray_sieve(instructions_here().back());
//   const SiftedRays rays = sieve(arguments, corners, bounds);    // within a callback of Embree
//   rays.near & ~rays.hidden;                                     // one bit for each ray that is left
//
// Coordinates are grid units about the scene's centre, lowered by the Earth's curvature (scene.hpp). For a corner,
// `side` is its distance from the ray's vertical plane and `along` its place along the ray, both times the ray's
// length, and `rise` is its height above the ray times the squared length. Lengths are |x| + |y|, which is never too
// short.
//
// First look: where a line meets what lies under the triangle, it does so between its ends. What is computed for the
// corners then has sides of both signs but for place * length, and its greatest rise is at most place and height too
// low.
//
// Second look, at where edges cross the ray's plane. At corners beyond the ends a turn of the ray counts, too: let R be
// its length and the way from its origin to the farthest corner together. Sides and places along it are off by place *
// R, rises by 2 R (height * length + place * |z|). An edge whose ends are certainly on different sides (by twice what
// sides are off) crosses at a share of its length that is known to 6 place R / D, D the distance of both sides. The
// ground under the plane of the ray reaches from one crossing to another; it is at least as high there as the straight
// line between the lowered corners, and at most `bulge` higher, for the Earth's curvature is convex. (Where refraction
// bends lines more than the Earth does it is lower, and bounds find no hidden rays.) So a line is hidden for certain
// where one crossing, between its ends, is high enough; and certainly not by a triangle all of whose possible crossings
// are too low, before its one end or beyond the other. A ray is below its line by no more than a height is off, but
// where it is cast level at the floor; such rays are never said to be hidden.
#pragma once

#include <array>

#include "line/instructions.hpp"
#include "scene/rays/embree.hpp"

namespace itin::viewshed {

/// A triangle's corners.
struct SieveCorners {
  std::array<float, 3> x, y, z;
  float bulge = 0;  ///< how far it rises at most above its corners' plane
};

/// How far things are off at most.
struct SieveBounds {
  float place = 0, height = 0;
  float rounding = 0;         ///< share of a height by which it may be off besides
  float grazing = 0;          ///< how far the ground may rise above a line that it does not hide
  float floor = 0;            ///< rays that begin here are not those of lines
  bool finds_hidden = false;  ///< whether rays that are certainly hidden are told
};

/// One bit for each ray of a packet.
struct SiftedRays {
  unsigned near = 0;    ///< may be hidden by the triangle
  unsigned hidden = 0;  ///< certainly hidden by it; these are near, too
};

using RaySieve = SiftedRays (*)(const RTCOccludedFunctionNArguments& rays, const SieveCorners& at,
                                const SieveBounds& bounds);
/// Each set of instructions may leave other rays to double precision.
RaySieve ray_sieve(Instructions instructions);

}  // namespace itin::viewshed
