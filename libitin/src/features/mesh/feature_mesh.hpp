// Features as lines in the triangulation: what must be inserted into the terrain so that it carries buildings, walls,
// trees and terraces.
//
//   FeatureMesh mesh = build_feature_mesh(features, options, &terrain, progress);
//   // leave out the terrain's vertices and lines within mesh.masks, insert mesh.vertices and mesh.segments
//
// A building is its outline on the terrain (without terrain, at its base) and, the wall offset inside, rings at the
// height of its eaves, with the creases of its roof between them. A draped feature is built likewise, with heights
// above the terrain, whose edges it repeats within its top. Nothing makes the surface lower (terrain_overlay.hpp). Who
// gets the ground where footprints overlap, and where walls stand between those that touch, is the rule of
// footprint_arrangement.hpp.
//
// The segments are planar: they meet only at vertices, all of which lie on the grid, one per position. This is verified
// exactly; where it does not hold, snap rounding makes it so (and that is reported). Vertices without segments are
// ground repeated at the top of features that drape. The result depends on the features' order (which settles ties) but
// not on threads.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

#include "features/mesh/ground_border.hpp"
#include "features/mesh/terrain_heights.hpp"
#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

/// The class of a line; `wall` lies between feet and eaves.
enum class SegmentClass : std::uint8_t { foot, eaves, roof, wall };

struct FeatureSegment {
  std::uint32_t from, to;
  std::uint32_t feature;  ///< index of the feature it belongs to
  SegmentClass kind;
};

/// Ground that a feature covers, its border included; terrain vertices there are left out. Feet run along the border
/// (within a grid step of it, where lines had to be joined).
struct FeatureMask {
  std::uint32_t feature;
  GridPolygon polygon;
};

struct FeatureFinding {
  std::uint32_t feature;
  std::string text;  ///< one line
};

struct FeatureMesh {
  Grid grid;
  std::vector<GridPoint> vertices;  ///< in Morton order
  std::vector<FeatureSegment> segments;
  std::vector<FeatureMask> masks;        ///< disjoint but for their borders
  ChangedGround ground;                  ///< outside of masks or nearly, and under what drapes (terrain_overlay.hpp)
  std::vector<FeatureFinding> findings;  ///< by feature
  std::uint64_t built = 0;               ///< features that stand
  std::uint64_t refused = 0;             ///< features that do not, each with a finding
  std::uint64_t flat_instead = 0;        ///< roofs that were refused, each with a finding
};

/// Throws InputError unless the offset lies between two steps of the grid and 10 m.
void require_wall_offset(double metres, const Grid& grid);

struct FeatureOptions {
  Grid grid;
  double wall_offset = 0.05;  ///< metres
  double pitch_degrees = 35;  ///< taken for roofs that do not say theirs
};

/// Builds the mesh. Without terrain only buildings with a base of their own stand. Throws Cancelled, and InputError for
/// an offset or pitch out of range and for terrain on another grid. Errors in single features are reported, not thrown.
FeatureMesh build_feature_mesh(std::span<const FootprintFeature> features, const FeatureOptions& options,
                               const TerrainHeights* terrain, Progress& progress);

/// Returns a band about a line: the footprint of a wall, fence or hedge. The thickness is in metres. The result is
/// empty where the line has no length.
std::vector<PlanRing> band_about(const PlanRing& line, double thickness, const Grid& grid);

}  // namespace itin
