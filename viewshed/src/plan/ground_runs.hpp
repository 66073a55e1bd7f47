// Work cut into runs of pieces next to each other, each of as many pieces as the memory holds the ground of.
//
//   for (const GroundRun& run : ground_runs(tiles_by_azimuth, ground.count(), needed, fits))
//     triangulate(store, ground.window(run.ground), ...);                    // the surface under all of run.pieces
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "plan/ground_tiles.hpp"
#include "plan/partition.hpp"

namespace itin::viewshed {

struct GroundRun {
  std::vector<std::size_t> pieces;  ///< their numbers
  TileSet ground;                   ///< all ground that they need
};

/// Takes the pieces in their order. needed(piece) returns the set of ground tiles that a piece needs, of `tile_count`
/// tiles in all; fits(ground) tells whether so much ground can be read at once. The ground of a single piece need not
/// fit.
template <class Needed, class Fits>
std::vector<GroundRun> ground_runs(std::span<const std::size_t> pieces, std::size_t tile_count, const Needed& needed,
                                   const Fits& fits) {
  std::vector<GroundRun> runs;
  for (std::span<const std::size_t> left = pieces; !left.empty(); left = left.subspan(runs.back().pieces.size())) {
    auto run = longest_run(
        left.size(), TileSet(tile_count), [&](TileSet ground, std::size_t i) { return ground |= needed(left[i]); },
        fits);
    const auto taken = left.first(run.count);
    runs.push_back({{taken.begin(), taken.end()}, std::move(run.sum)});
  }
  return runs;
}

}  // namespace itin::viewshed
