// What is found out at a coarse level before a surface of triangles is read: which of an eye's cells the level decides,
// and which ground the other cells need.
//
//   const auto pass = make_coarse_pass(way, std::move(envelope), {request, ground, rim, tiles, result});
//   const CoarsePass::Left left = pass->decide(eye, verdicts);
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/result.hpp>

#include "plan/ground_tiles.hpp"
#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "run/eye_verdicts.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

enum class CoarseWay : std::uint8_t {
  kNothing,  ///< decides nothing: all ground under the lines is needed
  kRays,     ///< finds over the full surface what is hidden or visible, and where other lines come near the ground
  kBlocks,   ///< finds over a level's surface cells that are hidden, and what is not hidden of the ground under lines
};
CoarseWay coarse_way(const Store& store, const Request& request);

class CoarsePass {
 public:
  /// What a pass works with. All must outlive the pass.
  struct Over {
    const Request& request;
    const GroundTiles& ground;
    const std::vector<RimEdge>& rim;  ///< where ground ends
    const RasterGrid& tiles;          ///< its cells are tiles of the result's
    const Result& result;
  };
  struct Left {
    std::vector<TileSet> needed;  ///< the ground that each tile's undecided lines need; empty: there are none
    std::shared_ptr<const VoidShadow> shadow;
  };

  CoarsePass() = default;
  virtual ~CoarsePass() = default;
  CoarsePass(const CoarsePass&) = delete;
  CoarsePass& operator=(const CoarsePass&) = delete;

  /// Decides what it can of the cells that the eye is asked about.
  virtual Left decide(const Eye& eye, EyeVerdicts& verdicts) = 0;
};

/// Makes the pass; `envelope` encloses the full surface or, for kBlocks, the request's.
std::unique_ptr<CoarsePass> make_coarse_pass(CoarseWay way, Envelope envelope, const CoarsePass::Over& over);

}  // namespace itin::viewshed
