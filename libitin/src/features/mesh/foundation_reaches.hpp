// How far flat foundations bend the ground about them, and how deep they cut into it.
//
//   const FoundationReaches foundations(mesh, terrain, features);
//   const FeatureReach reach = foundations.of(m);   // at mesh.masks[m]
//
// The ground bends within the terrain's triangles that a foot crosses. There, the surface less the terrain is linear
// between feet and the terrain's vertices, so no part of it lies deeper than the feet do. Within the outline the
// terrain may be higher than at the feet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "features/mesh/feature_mesh.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// Refers to all arguments of its constructor, which must outlive it.
class FoundationReaches {
 public:
  FoundationReaches(const FeatureMesh& mesh, const TerrainHeights& terrain,
                    const std::vector<FootprintFeature>& features)
      : mesh_(mesh),
        terrain_(terrain),
        features_(features),
        any_(std::any_of(features.begin(), features.end(), founded)) {}

  /// The reach of a mask: its box alone, with no height, where the feature leaves the ground about it as it is.
  FeatureReach of(std::size_t mask) const;

 private:
  static bool founded(const FootprintFeature& feature) {
    return feature.kind == FeatureKind::building && feature.flat_foundation;
  }
  std::optional<std::int32_t> height_of_vertex(Position p) const;

  const FeatureMesh& mesh_;
  const TerrainHeights& terrain_;
  const std::vector<FootprintFeature>& features_;
  bool any_;  ///< whether any feature has a flat foundation
};

}  // namespace itin
