// A feature as a source gives it, put on the grid and onto the ground: repaired, with its base and its heights.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "features/mesh/feature_group.hpp"

namespace itin {

/// Surfaces steeper than this are walls, whatever they are called; seen from above they are next to nothing.
inline constexpr double kSteepestRoof = 10;

struct Preparation {
  PreparedFeature feature;
  std::vector<std::string> findings;  ///< one line each; if it cannot stand, the last says why
  bool raised = false;
};

Preparation prepare(const FootprintFeature& feature, std::uint32_t number, const FeatureOptions& options,
                    const TerrainHeights* terrain);

}  // namespace itin
