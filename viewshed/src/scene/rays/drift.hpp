// How far a ray in single precision may run beside its line, and a surface raised enough to allow for that.
#pragma once

#include <vector>

#include <itin/tin.hpp>

namespace itin::viewshed {

/// The steepest slope of a triangle: grid units up per grid unit along.
double slope_of(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// How far beside its line a ray from one of these eyes, metres, may run: the greatest delta(l) of scene.hpp, in grid
/// units. 0 without eyes.
double greatest_drift(const std::vector<Point2>& eyes, const Tin& tin);

/// Raises the surface by what it may rise within delta(l) of a place, for lines from these eyes, metres. A ray that
/// clears the raised surface clears the surface as it was, though it runs beside its line. The surface is raised by
/// twice as much, since raising it changes the slopes of neighbouring triangles. Without eyes it stays as it is.
void raise_against_drift(const std::vector<Point2>& eyes, Tin& tin);

}  // namespace itin::viewshed
