// The values that a mode keeps of the lines to a tile's cells.
//
//   Observations observations(request);
//   const std::unique_ptr<Observation> observation = observations.of_tile();
//   const auto work = judge.begin_exactly(i);
//   lines += observation->observe({*work, eye, observer, progress});   // one observer after another, in any order
//   observation->store(tile_at(grid, tiles, i), result, cells);
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <viewshed/result.hpp>

#include "judge/exact_judge.hpp"
#include "line/cell_tiles.hpp"
#include "line/verdicts.hpp"
#include "modes/blocker_table.hpp"
#include "modes/lines/triangle_studies.hpp"
#include "request/cells_in_view.hpp"
#include "request/eye.hpp"
#include "scene/exact_scene.hpp"

namespace itin::viewshed {

/// An observer's view of the target in a cell.
struct CellView {
  std::size_t cell = 0;           ///< in the tile
  std::uint32_t observer = 0;     ///< from 0
  double dx = 0, dy = 0, dz = 0;  ///< metres from the eye to the target, as Eye::offset_to()
  double squared_distance() const { return dx * dx + dy * dy; }
};

/// One observer's view of the cells of a tile.
struct TileView {
  ExactJudge::ExactWork& work;
  std::size_t number;      ///< the eye's number in the judge
  std::uint32_t observer;  ///< from 0
  const Progress& progress;
  const TriangleStudies* studies = nullptr;  ///< made for the surface, where the mode needs them

  const EyeView& from() const { return work.view(number); }
  const Eye& eye() const { return from().eye; }
  /// Tells whether the line from the eye to a place, grid units, crosses ground without data.
  bool crosses_void(double x, double y) const { return from().shadow && from().shadow->holds(x, y); }
  ExactScene::TileCells& cells() const { return work.cells; }
  double resolution() const { return work.surface().units().resolution; }

  /// Calls visit(view) for every cell that has ground; the views are of the ground.
  template <class Visit>
  void for_each_cell(const Visit& visit) const;
};

/// The outcome of a line between places that differ horizontally; grid units.
struct Sight {
  const Eye& eye;
  Point3 from, to;
  Verdict verdict = Verdict::kHidden;  ///< or visible, or undecided
};

/// A row of a tile's cells, and where they are in the result's rasters.
struct StoredRow {
  std::size_t cell = 0;  ///< the first, in the tile
  std::size_t columns = 0;
  std::size_t place = 0;  ///< where the first is in the rasters
  std::size_t step = 1;   ///< how many places apart the cells are

  /// Calls visit(cell, place) for each of the cells.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < columns; ++i) visit(cell + i, place + i * step);
  }
};

class Observation {
 public:
  Observation() = default;
  virtual ~Observation() = default;
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// Tells whether it could matter that the target is seen, whatever its height.
  virtual bool open(const CellView&) const { return true; }
  /// Adds one observer's verdict, where that is all that is known.
  void add(const CellView& view, Verdict verdict) {
    verdicts_.add(view.cell, verdict);
    if (verdict == Verdict::kVisible) keep(view);
  }
  void add(const TileValues<Verdict>& of_observer) { verdicts_.add(of_observer); }
  /// Tells whether an observer certainly sees a cell.
  bool sees(std::size_t cell) const { return !verdicts_.open(cell); }
  /// Tells whether more is asked of a hidden target than that it is hidden.
  virtual bool asks_of_the_hidden() const { return false; }
  /// Adds all cells of these parts of the tile as hidden, and returns their number.
  std::uint64_t hide(const Tile& tile, std::span<const Tile> parts);
  /// Adds what the observer sees of every cell that is open. Returns how many sight lines that took. Throws Cancelled.
  virtual std::uint64_t observe(const TileView& tile);
  /// Counts the cells, and writes their values to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const;

  /// Makes room in the result for what store() writes: rasters of cells that are outside.
  static void prepare(Result& result);

 protected:
  Verdicts& verdicts() { return verdicts_; }
  const Verdicts& verdicts() const { return verdicts_; }

 private:
  /// Qualifies an eye's verdicts by what else the mode asks of its lines, before they are added.
  virtual void qualify(const TileView&, TileValues<Verdict>&) {}
  /// Keeps what the mode wants of a target that is seen, and whose verdict has been added.
  virtual void keep(const CellView&) {}
  /// Studies a target that the eye looks at, and that is not straight above or below it.
  virtual void study(const TileView&, const CellView& view, const Sight& sight) {
    if (sight.verdict == Verdict::kVisible) keep(view);
  }
  virtual void store_row(const StoredRow&, Result&) const {}

  Verdicts verdicts_;
};

/// Makes the Observations of a request's mode. The request must outlive this, and this must outlive the observations.
class Observations {
 public:
  explicit Observations(const Request& request) : request_(request) {}

  std::unique_ptr<Observation> of_tile();
  /// Completes what tiles have in common, after the last of them has been stored.
  void finish(Result& result) const;

 private:
  const Request& request_;
  BlockerTable blockers_;
};

template <class Visit>
void TileView::for_each_cell(const Visit& visit) const {
  const TileValues<double>& ground = cells().ground;
  const double metres = resolution(), elevation = eye().elevation;
  for_each_offset(eye(), work.surface().grid(), cells().tile, cells().centres,
                  [&](std::size_t cell, const Point2& offset) {
                    if (std::isnan(ground[cell])) return;
                    visit(CellView{cell, observer, offset.x, offset.y, ground[cell] * metres - elevation});
                  });
}

}  // namespace itin::viewshed
