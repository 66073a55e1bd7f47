// How much of an upright axis, such as a turbine, is seen from every cell of a tile: the least height of the axis at
// which nothing hides it. In the other direction, from an eye: which cells' targets it sees, and from what height on.
//
//   RadialSweep sweep(earth, bins);
//   const RadialSweep::View view = sweep.view_of(axis);       // for all tiles
//   RadialSweep::Heights heights;                             // grid units, one per cell
//   sweep.run(view, eyes, scratch, heights);
//
// Method. Horizons of far ground are computed once for all tiles (horizon_hierarchy.hpp). The tile is cut into sectors
// about the axis, each about a cell wide at its far end. Along a sector the bounds of BinnedHeights say for nearly
// every slab and eye that it hides the whole axis, or that it hides nothing. The rest, mostly the slabs about a line's
// silhouette and the ground before the eye, is decided triangle by triangle in double precision. An eye begins with
// what hid its neighbours, so that bounds leave little to decide.
//
// Accuracy. Every triangle that may hide more than what is known is looked at exactly, and bounds decide by more than
// rounding. So the line at the height found has a clearance between -kGrazing and 0, up to rounding, or the height is
// the lower bound; a line is reported hidden only where a triangle or a bound proves it. It agrees with single lines of
// sight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <itin/earth.hpp>
#include <itin/progress.hpp>

#include "bounds/binned_heights.hpp"
#include "line/cell_tiles.hpp"
#include "line/sight_line.hpp"
#include "scene/sweep/horizon_view.hpp"
#include "scene/sweep/sector_profile.hpp"

namespace itin::viewshed {

class RadialSweep {
 public:
  /// `surface` must outlive it.
  RadialSweep(const Earth& earth, const BinnedHeights& surface);

  using Axis = HorizonView::Axis;
  /// The other ends of lines, one per cell of a tile, NaN where none is.
  struct Ends {
    const Tile& tile;
    const TileCentres& centres;
    const TileValues<double>& elevation;  ///< grid units
  };
  /// Each cell has the least height seen, from base to top, or NaN where a sight line to its top is hidden. Eyes at the
  /// axis' own place (itin/same_place.hpp), and beyond its radius, are left out: they have infinity.
  using Heights = TileValues<double>;

  /// What the tiles about an axis share.
  using View = HorizonView;
  View view_of(const Axis& axis) const;
  /// Begins a view, to be advanced.
  View beginning(const Axis& axis) const;
  /// The axis of an eye that looks as far as there is surface, but no farther than `radius` grid units.
  Axis axis_at(const Point3& eye, double radius) const;

  /// Memory to use again.
  using Scratch = SectorProfile;
  /// Computes the heights seen. May run in several threads at once, each with its own scratch. Cost: some hundredths of
  /// a microsecond per eye that does not see the top, a few tenths for others.
  void run(const View& axis, const Ends& eyes, Scratch& scratch, Heights& heights) const;

  /// Decides the lines from an eye to targets, to the last bit as the line from the eye over every triangle does: NaN
  /// where hidden, infinity for a target at the eye's own place, else the eye's height.
  void decide(const View& eye, const Ends& targets, Scratch& scratch, Heights& seen) const;

  /// The lowest end that counts in each cell, and another end that is wanted, which need not lie within the range.
  struct Lowest {
    const TileValues<double>& end;
    const TileValues<double>& wanted;
  };
  /// Finds how high a cell's end must be for the eye to see it, from the lowest up to `highest`; NaN where the highest
  /// is hidden, infinity for a cell at the eye's own place. The line to a height found touches the surface, or the
  /// height is one of the three given. The height is at most one of these exactly where decide() sees that one. Cost:
  /// some tenths of a microsecond per cell that does not see the lowest. Throws Cancelled.
  void raise_from(const View& eye, const Ends& highest, const Lowest& lowest, Scratch& scratch, Heights& least,
                  const Progress& progress = NoProgress()) const;

 private:
  enum class Kind : std::uint8_t { kAxis, kPoint, kHeight };
  class Task;

  const BinnedHeights& bins_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
};

}  // namespace itin::viewshed
