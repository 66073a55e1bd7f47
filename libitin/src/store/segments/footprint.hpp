// A feature that stands on the ground, as sources give it: its footprint in plan and its heights.
//
// Units: metres, in the CRS of the store. Rings are open or closed, of any orientation, and are read by the even-odd
// rule: a ring inside another is a courtyard, one inside that is solid again. Sources give features of several parts,
// whose union the rings are (features/mesh/united_parts.hpp).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/theme.hpp>

namespace itin {

/// The kind of a feature. `cells` is a part of a raster of heights, from which features are made when they are raised.
enum class FeatureKind { building, vegetation, wall, terrace, cells };

using PlanRing = std::vector<Point2>;

/// A plane piece of a roof with its elevations; the first ring is its outline, all others are holes.
struct RoofSurface {
  std::vector<std::vector<Point3>> rings;
};

/// Stands for the height of a cell that has none.
inline constexpr std::int32_t kNoHeight = std::numeric_limits<std::int32_t>::min();

/// Heights of the cells of a part of a raster, and the rule by which they become steps (features/cell_patches.hpp).
/// Heights, step and threshold are whole millimetres.
struct HeightCells {
  /// The raster's first corner, and the steps from a cell to the next one of its row and of its column; metres.
  Point2 corner, across, down;
  std::int32_t first_column = 0, first_row = 0, columns = 0, rows = 0;  ///< the cells of the raster in this part
  bool absolute = false;                                                ///< elevations; else heights above the ground
  std::int32_t step = 0, threshold = 0;
  HeightRounding rounding = HeightRounding::nearest;
  std::vector<std::int32_t> heights;  ///< row by row; kNoHeight where a cell has none

  /// Returns the place of a cell's corner, counted from this part's first cell. Parts of a raster compute the same
  /// place for a corner that they share.
  Point2 corner_at(double column, double row) const {
    const double c = first_column + column, r = first_row + row;
    return {corner.x + c * across.x + r * down.x, corner.y + c * across.y + r * down.y};
  }
};

struct FootprintFeature {
  std::string name;  ///< the name of the feature in messages
  FeatureKind kind = FeatureKind::building;
  std::vector<PlanRing> rings;
  BaseRule base_rule = BaseRule::minimum;
  bool flat_foundation = false;  ///< a building's outline lies at its base, not on the terrain
  std::optional<double> base;    ///< elevation; default: from the terrain. Only buildings have one: everything else
                                 ///< drapes
  std::optional<double> height;  ///< height of the highest point above the base (above the terrain, where the feature
                                 ///< drapes)
  std::optional<double> eaves;   ///< height of the eaves above the base; default: from height and pitch
  RoofKind roof = RoofKind::flat;
  std::vector<RoofSurface> surfaces;  ///< a measured roof; takes the place of height, eaves and roof
  std::optional<HeightCells> cells;   ///< given for the kind `cells`; the ring encloses them all
};

inline std::uint64_t vertex_count(const FootprintFeature& feature) {
  std::uint64_t count = 0;
  for (const PlanRing& ring : feature.rings) count += ring.size();
  for (const RoofSurface& surface : feature.surfaces)
    for (const auto& ring : surface.rings) count += ring.size();
  return count;
}

}  // namespace itin
