// The values that a mode keeps of the lines to a tile's cells.
//
//   const Observations observations(request, tin);
//   const std::unique_ptr<Observation> observation = observations.of_tile();
//   // One observer after another.
//   lines += observation->look({surface, eye, view, observer, nullptr, *surface.begin(i)});
//   observation->store(tile_at(grid, tiles, i), result, cells);
//
// The result does not depend on the order of the looks.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <viewshed/viewshed.hpp>

#include "line/cell_tiles.hpp"
#include "modes/blocker_table.hpp"
#include "modes/triangle_studies.hpp"
#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"

namespace itin::viewshed {

/// An observer's look at the target in a cell.
struct Look {
  std::size_t cell = 0;           ///< in the tile
  std::uint32_t observer = 0;     ///< from 0
  double dx = 0, dy = 0, dz = 0;  ///< metres from the eye to the target, as Eye::offset_to()
  double squared_distance() const { return dx * dx + dy * dy; }
};

/// One observer's looks at the cells of a tile.
struct TileLook {
  const FullSurface& surface;
  const Eye& eye;
  const RadialSweep::View& view;  ///< the eye's
  std::uint32_t observer;
  const VoidShadow* shadow;  ///< shadow_of() the eye; may be null
  FullSurface::TileWork& work;
  const TriangleStudies* studies = nullptr;  ///< of the surface, where the mode needs them

  /// Calls visit(look) for every cell that has ground; the looks lead to the ground.
  template <class Visit>
  void for_each_cell(const Visit& visit) const;
};

/// The outcome of a line between places that differ horizontally; grid units.
struct Sight {
  const Eye& eye;
  Point3 from, to;
  bool seen = false;
};

class Observation {
 public:
  Observation() { values_.fill(Verdict::kOutside); }
  virtual ~Observation() = default;
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  /// The cell is in an observer's field of view.
  void enter(std::size_t cell) {
    if (values_[cell] == Verdict::kOutside) values_[cell] = Verdict::kHidden;
  }
  /// Whether it could matter that the target is seen, whatever its height.
  virtual bool open(const Look&) const { return true; }
  /// The target is seen.
  void see(const Look& look) {
    mark_visible(look.cell);
    keep(look);
  }
  /// The target is seen across ground without data, which may hide it.
  void mark_undecided(std::size_t cell) {
    if (values_[cell] != Verdict::kVisible) values_[cell] = Verdict::kUndecided;
  }
  /// Looks at every cell that is open. Returns how many sight lines that took.
  virtual std::uint64_t look(const TileLook& tile);
  /// Counts the cells, and writes them to their places in the result.
  void store(const Tile& tile, Result& result, CellCounts& cells) const;

  /// Makes room in the result for what store() writes.
  static void prepare(Result& result);

 protected:
  Verdict value(std::size_t cell) const { return values_[cell]; }
  void mark_visible(std::size_t cell) { values_[cell] = Verdict::kVisible; }

 private:
  virtual void keep(const Look&) {}
  virtual void judge(const TileLook&, const Look& look, const Sight& sight) {
    if (sight.seen) see(look);
  }
  /// A row of `columns` cells, from `cell` in the tile to `place` in the grid.
  virtual void store_row(std::size_t, std::size_t, std::size_t, Result&) const {}

  TileValues<Verdict> values_;
};

/// Holds what ground without data, beyond this rim, hides from the eye or leaves undecided, where that changes the
/// result.
std::optional<VoidShadow> shadow_of(const Eye& eye, const std::vector<RimEdge>& rim, const Result& result);

/// Makes the Observations of a request's mode. The request must outlive it, and it must outlive them.
class Observations {
 public:
  explicit Observations(const Request& request) : request_(request) {}

  std::unique_ptr<Observation> of_tile();
  /// One of each.
  std::vector<std::unique_ptr<Observation>> of_tiles(const RasterGrid& tiles);
  /// After the last of them has been stored: completes what tiles have in common.
  void finish(Result& result) const;

 private:
  const Request& request_;
  BlockerTable blockers_;
};

/// Makes room in the result and writes all tiles' observations and counts to it.
void store_all(const std::vector<std::unique_ptr<Observation>>& observations, const RasterGrid& tiles, Result& result);

template <class Visit>
void TileLook::for_each_cell(const Visit& visit) const {
  surface.for_each_offset(eye, work, [&](std::size_t cell, const Point2& offset) {
    if (std::isnan(work.ground[cell])) return;
    const double ground = work.ground[cell] * surface.units().resolution;
    visit(Look{cell, observer, offset.x, offset.y, ground - eye.elevation});
  });
}

}  // namespace itin::viewshed
