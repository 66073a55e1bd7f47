// The first draft of the pyramid: every point's level by greedy insertion, tile by tile, and the coverage.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/progress.hpp>

#include "pyramid/levels/post_hierarchy.hpp"
#include "pyramid/points/source_index.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

struct Proposal {
  std::vector<Segment> outline;         ///< the outline of the ground, in short pieces (coverage.hpp)
  std::vector<std::uint64_t> isolated;  ///< Morton codes of points that no ground triangle has
  std::vector<LevelRaise> raised;       ///< posts of the hierarchy that it had left to finer levels
};

/// How far a tile's proposed levels depend on others: on the tiles that it reaches or that reach it (reach_of()), so
/// many times over. The first time is for a tile of the second wave, which raises points of the tile; the second for
/// one of the first wave, whose levels that one starts from; the third for one whose points that one sees. The fine
/// levels of posts there depend on PostHierarchy::kReach posts more.
inline constexpr int kReachesOfProposal = 3;

/// Writes the levels that the points should have, as far as one tile can tell; certify.hpp has the last word.
///
/// The tiles come in two waves, like the squares of a chessboard. A tile of the second wave starts from the levels that
/// its neighbours have already, so that both sides of a border agree. It may also raise points just across its border
/// that the first wave left too fine. Tiles of one wave see nothing of each other's choice. So the outcome depends on
/// the points near by (kReachesOfProposal), not on threads and not on how many tiles there are.
///
/// Posts of the hierarchy have their fine levels already.
///
/// `gap_bases` (per source) and `tolerances` (per level) are in grid units.
Proposal propose_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                        const std::vector<std::array<double, 4>>& gap_bases, std::span<const double> tolerances,
                        const PostHierarchy& posts, Progress& progress);

/// Finds the coverage alone, by the points of the given sources, or of all.
Proposal find_ground(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                     const std::vector<std::array<double, 4>>& gap_bases, const Sources* ground, Progress& progress);

/// Proposes the levels alone, where the index has its lines already. Points that have a level keep it, or get a coarser
/// one.
Proposal propose_levels_with_lines(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                   std::span<const double> tolerances, const PostHierarchy& posts, Progress& progress);

}  // namespace itin
