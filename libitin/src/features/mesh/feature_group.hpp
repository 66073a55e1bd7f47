// Features that may touch each other, turned into lines together: one step of build_feature_mesh().
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "features/mesh/feature_mesh.hpp"
#include "features/mesh/footprint_arrangement.hpp"
#include "features/mesh/ground_border.hpp"
#include "features/mesh/roof.hpp"

namespace itin {

/// A feature on the grid. Heights are in grid units.
struct PreparedFeature {
  std::uint32_t number = 0;  ///< the feature's number in the call
  FeatureKind kind = FeatureKind::building;
  RoofKind roof = RoofKind::flat;
  bool measured = false;         ///< each patch is a plane piece of roof; else there is one patch
  RoofHeights heights;           ///< only a building has these
  bool flat_foundation = false;  ///< its outline lies at its base
  double above_terrain = 0;      ///< how high a feature that drapes stands above the terrain
  std::vector<Patch> patches;

  bool drapes() const { return kind != FeatureKind::building; }
};

struct PlacedSegment {
  GridPoint a, b;
  std::uint32_t feature;
  SegmentClass kind;
};

struct GroupMesh {
  std::vector<PlacedSegment> segments;
  std::vector<GridPoint> loose;  ///< vertices without segments
  std::vector<FeatureMask> masks;
  ChangedGround ground;
  std::vector<FeatureFinding> findings;
  std::vector<std::uint32_t> refused;  ///< numbers of features
  std::uint64_t flat_instead = 0;
};

/// Builds the lines of a group; `offset` is in grid units. Throws Cancelled.
GroupMesh build_group(std::vector<PreparedFeature> features, double offset, const TerrainHeights* terrain,
                      const Progress& progress);

/// Makes lines of the terrain raised over a plan: the plan's rings as eaves, and the terrain's edges near them as
/// creases, so that the terrain's triangles inside come out as they are. Appends the vertices that stand by
/// themselves. Returns false, and appends nothing, where the plan reaches beyond the terrain.
bool drape(const GridPolygon& plan, double above, const TerrainHeights& terrain, std::vector<RoofLine>& lines,
           std::vector<GridPoint>& loose, const Progress& progress);

}  // namespace itin
