// The cells of a viewshed while surfaces decide them. All loops over a viewshed's tiles are here.
//
//   ViewshedCells cells(result, sink, call.step(1));
//   cells.observe({judge, 0, cells.in_order()});   // what the mode asks, over the surface itself
//   cells.judge(block_judge, within_reach);        // or only what a level is certain of
//   cells.finish();
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
#include "line/tile_parts.hpp"
#include "modes/observation.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

/// Cells that are decided together, over one surface in memory.
struct Portion {
  const ExactJudge& judge;
  std::uint32_t first = 0;  ///< the observer of the judge's first eye; its other eyes are the observers after it
  std::span<const PartsOfTile> cells;
  const TriangleStudies* studies = nullptr;  ///< the surface's, where the mode needs any
  bool last = false;                         ///< nothing else is asked about these tiles
};

class ViewshedCells {
 public:
  /// Begins the cells of the result, whose request and grid are given. Each cell is a step of the progress for each
  /// observer. The sink gets tiles as they are stored. All must outlive this object.
  ViewshedCells(Result& result, const CellSink& sink, Progress& progress);

  Result& result() { return result_; }
  const RasterGrid& tiles() const { return tiles_; }
  /// All cells, in the order in which tiles are begun: where a sink waits for them, the nearest to an observer first.
  std::vector<PartsOfTile> in_order() const { return all_cells(result_.grid, tiles_, order_); }
  /// What has been kept of a tile. Safe for concurrent use with different tiles.
  Observation& of_tile(std::size_t tile);

  /// Observes the portion's cells on all threads, each from the nearest of its eyes first, and counts the sight lines.
  /// Throws Cancelled.
  void observe(const Portion& portion);
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
  std::uint64_t observe(const Portion& portion, const PartsOfTile& cells);
  std::vector<std::size_t> eyes_near(const ExactJudge& judge, std::size_t tile) const;
  std::vector<std::size_t> order_of_tiles() const;
  void store(std::size_t tile);

  Result& result_;
  const CellSink& sink_;
  std::mutex sinking_;
  const RasterGrid tiles_;
  const std::vector<std::size_t> order_;  ///< the numbers of all tiles
  Stage stage_;
  Observations modes_;
  std::vector<std::unique_ptr<Observation>> observations_;  ///< each tile's, until it is stored
  std::vector<CellCounts> counts_;                          ///< each tile's, once it is stored
};

}  // namespace itin::viewshed
