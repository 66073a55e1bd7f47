// The area that a ring encloses by the even-odd rule, even where it crosses itself.
#pragma once

#include "features/plan/plan_overlay.hpp"

namespace itin {

/// The faces that a ring winds about an odd number of times, as polygons that meet at vertices only. Snap rounding
/// makes them, so that every edge lies within a grid step of the ring. O((n + k) log n) for n edges and k crossings:
/// bound k first.
GridPolygons odd_faces(const GridRing& ring);

}  // namespace itin
