// The cells of a viewshed while surfaces decide them. All loops over a viewshed's tiles are here.
//
//   ViewshedCells cells(result, sink, false, call.step(1));
//   cells.observe({judge, 0}, parts);         // what the mode asks, over the surface itself
//   cells.judge(block_judge, within_reach);   // or only what a level is certain of
//   cells.finish();
//
// Where a sink waits and the surface is in memory at once, observe_all() goes over the cells three times: over 1 in 81,
// over 1 in 9, and over all. The first two passes cost an eighth of the last, and what they tell of a cell is final.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/viewshed.hpp>

#include "judge/exact_judge.hpp"
#include "line/cell_tiles.hpp"
#include "line/tile_parts.hpp"
#include "modes/observation.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

/// Eyes over one surface in memory.
struct Portion {
  const ExactJudge& judge;
  std::uint32_t first = 0;  ///< the observer of the judge's first eye; its other eyes are the observers after it
  const TriangleStudies* studies = nullptr;  ///< the surface's, where the mode needs any
  bool last = false;                         ///< nothing else is asked about the tiles that are observed
};

class ViewshedCells {
 public:
  /// Begins the cells of the result, whose request and grid are given. Each cell is a step of the progress for each
  /// observer. The sink gets tiles as they are stored. `in_passes`: all cells will be observed by observe_all(). All
  /// must outlive this object.
  ViewshedCells(Result& result, const CellSink& sink, bool in_passes, Progress& progress);

  Result& result() { return result_; }
  const RasterGrid& tiles() const { return tiles_; }
  const Progress& progress() const { return progress_; }
  /// What has been kept of a tile. Safe for concurrent use with different tiles.
  Observation& of_tile(std::size_t tile) { return of_tile(passes_.back(), tile); }

  /// Observes some cells on all threads, each from the nearest of the portion's eyes first, and counts the sight lines.
  /// Throws Cancelled.
  void observe(const Portion& portion, std::span<const PartsOfTile> cells) { observe(portion, passes_.back(), cells); }
  /// Observes all cells, pass after pass.
  void observe_all(const Portion& portion);
  /// Judges cells for the first eye of a judge that may leave some undecided. A cell that an eye certainly saw before
  /// is not judged again. Throws Cancelled.
  void judge(const TileJudge& judge, std::span<const PartsOfTile> cells);
  /// Advances the progress to all cells of the first `eyes` observers, even where these do not look at all of them.
  void advance_past(std::size_t eyes);

  /// Runs body(i), which returns how many cells it has decided, for i in [0, count) on all threads, in their order
  /// where a sink waits. Throws Cancelled.
  template <class Body>
  void for_each(std::size_t count, const Body& body) {
    sink_ ? stage_.for_each_in_order(count, body) : stage_.for_each(count, body);
  }

  /// Writes what has not been written of the cells and their counts to the result.
  void finish();

 private:
  /// Cells that lie equally far apart, in tiles, and what is known of them.
  struct Pass {
    SteppedTiles tiles;
    bool last;                                                 ///< it has all cells
    std::vector<std::size_t> order;                            ///< the numbers of all tiles, as they are begun
    std::vector<std::unique_ptr<Observation>> observations{};  ///< each tile's, until it is stored
  };
  Pass pass(std::int64_t step) const;
  std::vector<std::size_t> order_of(const SteppedTiles& tiles) const;
  Observation& of_tile(Pass& pass, std::size_t tile);
  void observe(const Portion& portion, Pass& pass, std::span<const PartsOfTile> cells);
  std::uint64_t observe(const Portion& portion, Pass& pass, const PartsOfTile& cells);
  std::vector<std::size_t> eyes_near(const ExactJudge& judge, const Tile& tile) const;
  void store(Pass& pass, std::size_t tile);

  Result& result_;
  const CellSink& sink_;
  const Progress& progress_;
  std::mutex sinking_;
  const RasterGrid tiles_;
  std::vector<Pass> passes_;  ///< the last one has all cells
  Stage stage_;
  Observations modes_;
  std::vector<CellCounts> counts_;  ///< each tile's in the last pass, once it is stored
};

}  // namespace itin::viewshed
