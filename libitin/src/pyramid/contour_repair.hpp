// Repair of contours at import: points inferred in their flat triangles (features/contours/flat_skeleton.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>

#include "features/contours/flat_triangles.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// Finds the flat triangles of a full surface. They depend on the surface alone, not on the tiles. Memory follows the
/// vertices of the contours, as all work on lines does: about 240 bytes each.
class FlatSurvey {
 public:
  /// The index has its lines already. `contours` and `water` are segments of these lines. A triangle between the
  /// vertices of water is rightly flat.
  FlatSurvey(const WorkingIndex& index, const std::vector<CurveRange>& tiles, const std::vector<Segment>& contours,
             const std::vector<Segment>& water, Progress& progress);

  std::uint64_t triangles() const { return flat_.triangles().size(); }
  /// The inferred points in Morton order, distinct, at places without a vertex.
  std::vector<GridPoint> inferred() const;

 private:
  FlatTriangles flat_;
};

}  // namespace itin
