// Outlines of buildings as they were imported, for maps.
//
//   const OutlineDetail detail{.tolerance = 0.1 * pixel, .least = 2 * pixel};
//   for (const std::vector<Point2>& ring : building_outlines(store, ThemeChoice::all(), box, detail)) draw(ring);
#pragma once

#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin {

/// The precision of outlines in a picture, metres.
struct OutlineDetail {
  double tolerance = 0;  ///< vertices that lie nearer to the rest are left out
  double least = 0;      ///< rings that are smaller than this from west to east and from south to north are left out
};

/// Returns closed rings, courtyards among them, of all buildings and terraces of the chosen themes that meet the box.
/// For a building with measured roofs but no footprint, they are the outlines of its roof planes. Empty where buildings
/// do not stand on the ground. Reads all footprints of these themes, about a microsecond each. Throws CorruptStore.
std::vector<std::vector<Point2>> building_outlines(const Store& store, const ThemeChoice& themes, const Box& box,
                                                   const OutlineDetail& detail);

}  // namespace itin
