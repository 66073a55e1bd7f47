// Points along ridges, valleys, passes, hilltops and pits, inferred from the skeleton of a region of flat triangles
// (Ware 1998, see flat_triangles.hpp).
//
// The skeleton joins the middles of the region's inner edges; where three meet in a triangle, by way of its centroid. A
// branch ends at the tip of a bend of the contour, whose height is known, or leaves the region through an exit. Then it
// ends at a vertex beyond, whose height is known as well: the next contour in the valley, or a spot height on the top.
// - Along the way from the exit to the farthest tip the height changes evenly; other branches run evenly from there to
//   their tips.
// - Where the ways from two exits meet is a pass, or a saddle of a ridge: its height is extrapolated by the slope of
//   the contour interval beside the region.
// - A region without exits is a hilltop, or a pit where the ground outside is higher. Its height is extrapolated by the
//   slope of the contour interval outside, away from the contour.
// An extrapolated height stays within half of the contour interval. Where nothing outside tells the slope, as about a
// lone contour, nothing is inferred.
#pragma once

#include <vector>

#include "features/contours/flat_triangles.hpp"

namespace itin {

/// The points inferred for one region, perhaps none. They lie strictly inside it or, by an exit, in the triangle
/// beyond. Points of different regions are distinct, except in triangles of a few grid steps.
std::vector<GridPoint> infer_points(const FlatTriangles& flat, const FlatTriangles::Region& region);

}  // namespace itin
