// Coarse levels with few points, each triangulated once as a whole.
//
// Across the sea coarse triangles are long. To make and prove them again in every cell that they meet takes far longer
// than everything else, as each proof looks at the coasts all around.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "pyramid/points/working_index.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

class WholeLevels {
 public:
  /// Triangulates those of these levels (bit k for level k) that have few enough points, the coarsest first. Takes some
  /// 100 bytes for each of their points.
  WholeLevels(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, unsigned levels);

  /// What triangulate_region() returns for the box, or nothing where the level is not there. The index must not have
  /// changed.
  std::optional<RegionMesh> in(int level, const GridBox& box) const;

 private:
  /// A level's triangles, and the numbers of those whose boxes meet each square of a grid.
  struct Level {
    RegionMesh surface;
    BucketLists of_square;
  };
  void add(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, int level);
  template <class Visit>
  void for_each_square(const GridBox& box, const Visit& visit) const;

  GridBox bounds_;
  std::vector<std::optional<Level>> levels_;
};

}  // namespace itin
