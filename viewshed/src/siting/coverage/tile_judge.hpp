// Goes through the tiles of a grid, and within a tile from one site to the next, over whatever surface judges its
// cells.
//
//   class OverSomeSurface : public TileJudge { ... };
//   std::vector<CoverageBounds> after = judge_tiles(judge, survey, looks, progress, statistics);
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "line/cell_tiles.hpp"
#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

class TileJudge {
 public:
  TileJudge() = default;
  TileJudge(const TileJudge&) = delete;
  TileJudge& operator=(const TileJudge&) = delete;
  virtual ~TileJudge() = default;

  /// One thread's work on one tile.
  class Work {
   public:
    Work() = default;
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    virtual ~Work() = default;

    /// What the looks' option number `i` sees: Verdict::kUndecided cells become Verdict::kVisible, Verdict::kHidden or
    /// Verdict::kOutside, or stay. Returns how many sight lines that took.
    virtual std::uint64_t judge(std::size_t i, TileValues<Verdict>& values) = 0;
  };
  /// `tile` is one of those of the grid's.
  virtual std::unique_ptr<Work> begin(std::size_t tile) const = 0;
};

/// On all threads. The bounds are not yet said to be exact.
std::vector<CoverageBounds> judge_tiles(const TileJudge& judge, const SiteSurvey& survey, const SiteLooks& looks,
                                        Progress& progress, Statistics& statistics);

}  // namespace itin::viewshed
