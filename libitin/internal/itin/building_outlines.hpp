// Outlines of buildings as they were imported: for maps, and one by one.
//
//   const OutlineDetail detail{.tolerance = 0.1 * pixel, .least = 2 * pixel};
//   for (const std::vector<Point2>& ring : building_outlines(store, ThemeChoice::all(), box, detail)) draw(ring);
#pragma once

#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin {

/// Tells whether a theme's features are buildings or terraces.
inline bool is_of_buildings(const ThemeInfo& theme) {
  return theme.kind == ThemeKind::Buildings || theme.kind == ThemeKind::Terraces;
}

/// The precision of outlines in a picture, metres.
struct OutlineDetail {
  double tolerance = 0;  ///< vertices that lie nearer to the rest are left out
  double least = 0;      ///< rings that are smaller than this from west to east and from south to north are left out
};

/// Returns closed rings, courtyards among them, of all buildings and terraces of the chosen themes that stand and meet
/// the box.
/// For a building with measured roofs but no footprint, they are the outlines of its roof planes. Empty where buildings
/// do not stand on the ground. Reads all footprints of these themes, about a microsecond each. Throws CorruptStore.
std::vector<std::vector<Point2>> building_outlines(const Store& store, const ThemeChoice& themes, const Box& box,
                                                   const OutlineDetail& detail);

/// A building in plan.
struct BuildingFoot {
  std::uint16_t theme = 0;                 ///< its theme's number, from 1
  std::int64_t feature = 0;                ///< as FeatureAt::number
  std::vector<std::vector<Point2>> rings;  ///< closed, of any orientation; read by the even-odd rule
};

/// Returns the buildings and terraces of the chosen themes that stand and meet the box, in the order of themes and of
/// import. For a building with measured roofs but no footprint, the rings are those of its roof planes. Costs and
/// errors are those of building_outlines().
std::vector<BuildingFoot> building_feet(const Store& store, const ThemeChoice& themes, const Box& box);

}  // namespace itin
