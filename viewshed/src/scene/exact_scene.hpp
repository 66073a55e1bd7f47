// A whole surface in memory, and what an eye sees of what stands on it: exact, cell for cell. One of two engines
// decides the sight lines to cells, with the same answer: the sweep about the eye (sweep/radial_sweep.hpp), or rays
// (rays/scene.hpp).
//
//   ExactScene surface(tin, nullptr, request.earth, grid, tiles);
//   surface.cast_rays(request.earth);   // or not
//   const auto work = surface.begin(tile);
//   const auto view = surface.view_from(eye);
//   surface.judge(eye, view, values, *work);   // every Verdict::kUndecided cell becomes visible, hidden or outside
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/earth.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/binned_heights.hpp"
#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "line/cell_tiles.hpp"
#include "request/eye.hpp"
#include "scene/kept_ground.hpp"
#include "scene/rays/scene.hpp"
#include "scene/sweep/radial_sweep.hpp"

namespace itin::viewshed {

class ExactScene {
 public:
  /// `surface` hides; targets stand on it, or on `bare_ground` where that is given. `tiles` are the tiles of `grid`.
  /// All must outlive this object.
  ExactScene(const Tin& surface, const Tin* bare_ground, const Earth& earth, const RasterGrid& grid,
             const RasterGrid& tiles);
  ExactScene(const LatticeTin& surface, const Earth& earth, const RasterGrid& grid, const RasterGrid& tiles);
  /// Uses heights that have been binned before, and are shared; `surface` is null where they are a lattice's. `kept` is
  /// the ground that targets stand on, where it is kept, or else null.
  ExactScene(std::shared_ptr<BinnedHeights> heights, const Tin* surface, const Tin* bare_ground, const KeptGround* kept,
             const Earth& earth, const RasterGrid& grid, const RasterGrid& tiles);
  ExactScene(const ExactScene&) = delete;
  ExactScene& operator=(const ExactScene&) = delete;

  /// Lets rays decide the lines to cells from now on. Precondition: the surface is a Tin. Throws std::bad_alloc.
  void cast_rays(const Earth& earth);
  bool casts_rays() const { return rays_ != nullptr; }

  const Grid& units() const { return heights_->units(); }
  const RadialSweep& sweep() const { return sweep_; }
  const RasterGrid& grid() const { return grid_; }
  const RasterGrid& tiles() const { return tiles_; }
  /// The height of what hides, metres, if there is any at that position.
  std::optional<double> height(Point2 position) const;
  /// The edges where the surface ends.
  const std::vector<RimEdge>& rim() const { return heights_->rim(); }

  /// Holds what a tile's cells share between eyes, for one thread.
  struct TileCells {
    TileCells(const Grid& units, const RasterGrid& grid, const Tile& t) : tile(t), centres(units, grid, t) {}
    Tile tile;
    TileCentres centres;
    TileValues<double> ground;   ///< grid units; kNoSurface where none is, kUnread where no eye sees it
    bool unread = false;         ///< all of the ground is unread
    TileValues<double> targets;  ///< where the last eye's lines end; kNoSurface where none was needed
    RadialSweep::Heights seen;
    RadialSweep::Scratch scratch;
    Point3 target(std::size_t cell) const {
      const Point2 p = centres.at(cell);
      return {p.x, p.y, targets[cell]};
    }
  };
  std::unique_ptr<TileCells> begin(std::size_t tile) const;
  /// Begins a tile where only cells in these parts are asked about: others may have no ground.
  std::unique_ptr<TileCells> begin(const Tile& tile, std::span<const Tile> parts) const;

  /// Returns what all tiles share of an eye; with rays they share nothing.
  RadialSweep::View view_from(const Eye& eye) const {
    return rays_ ? sweep_.beginning(axis_of(eye)) : sweep_.view_of(axis_of(eye));
  }
  /// Surveys the ground towards the cells alone: ground beyond and beside them costs nothing. Throws Cancelled.
  RadialSweep::View view_of_cells(const Eye& eye, const Progress& progress) const;
  /// Begins a view of the eye, to be advanced.
  RadialSweep::View begin_view(const Eye& eye) const { return sweep_.beginning(axis_of(eye)); }
  /// Takes in heights of tiles of the lattice that have been read since: they count from now on.
  void add(std::span<const std::uint32_t> tiles) { heights_->add(tiles); }

  /// Tells whether a tile has ground at every cell and is certainly hidden from an eye, which looks at all of it.
  /// Bounds tell that, so that no height of the tile needs to be known.
  bool hides(const Eye& eye, const RadialSweep::View& view, const Tile& tile) const;

  /// Turns Verdict::kUndecided cells to Verdict::kVisible, Verdict::kHidden, or Verdict::kOutside where there is no
  /// ground or the eye does not look. Returns how many sight lines that took.
  std::uint64_t judge(const Eye& eye, const RadialSweep::View& view, TileValues<Verdict>& values,
                      TileCells& work) const;

  /// Calls RadialSweep::raise_from() up to work.targets; work.seen gets the heights. Throws Cancelled.
  void raise_from(const RadialSweep::View& view, const RadialSweep::Lowest& lowest, TileCells& work,
                  const Progress& progress = NoProgress()) const {
    sweep_.raise_from(view, {work.tile, work.centres, work.targets}, lowest, work.scratch, work.seen, progress);
  }
  /// Does so for a single place, given in metres; heights are in grid units.
  double raise_from(const RadialSweep::View& view, Point2 position, double lowest, double highest) const;

 private:
  RadialSweep::Axis axis_of(const Eye& eye) const {
    return sweep_.axis_at(eye.units, eye.view.farthest() / units().resolution + 1);
  }
  void raise_targets(const Eye& eye, TileValues<Verdict>& values, TileCells& work) const;
  void cast_rays_to_targets(const Eye& eye, TileCells& work) const;
  void find_ground(std::span<const Tile> parts, TileCells& work) const;
  std::span<const std::uint32_t> triangles_about(const Tile& tile, std::vector<std::uint32_t>& gathered) const;
  std::vector<BinBox> boxes_of_tiles() const;

  const Tin* surface_ = nullptr;     ///< what hides, where that is a Tin
  const Tin* targets_on_ = nullptr;  ///< what targets stand on, where that is a Tin
  const KeptGround* kept_ = nullptr;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  const std::shared_ptr<BinnedHeights> heights_;
  std::optional<TriangleBins> of_tiles_;  ///< that Tin's triangles, where `heights_` does not tell its heights well
  RadialSweep sweep_;
  std::unique_ptr<const Scene> rays_;
};

/// A ExactScene together with the surface that it is made of.
struct OwnedScene {
  /// Rays decide the lines to cells if wanted: then the surface must be a Tin.
  OwnedScene(RetrievedSurface of, std::optional<Tin> bare_ground, const Earth& earth, const RasterGrid& grid,
             const RasterGrid& tiles, bool rays = false)
      : surface(std::move(of)),
        ground(std::move(bare_ground)),
        full(surface.lattice ? ExactScene(surface.lattice->lattice(), earth, grid, tiles)
                             : ExactScene(surface.tin, ground ? &*ground : nullptr, earth, grid, tiles)) {
    if (rays) full.cast_rays(earth);
  }

  const RetrievedSurface surface;
  const std::optional<Tin> ground;  ///< none where the surface is a lattice
  ExactScene full;
};

}  // namespace itin::viewshed
