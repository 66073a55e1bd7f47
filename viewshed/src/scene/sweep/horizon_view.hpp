// The horizon about an upright axis, such as a mast: which boxes of ground, up to which height, it certainly does not
// see.
//
//   HorizonView view(bins, axis, drop, grazing);
//   view.advance(kInfinity);
//   if (view.hides(box, highest)) ...           // every target in the box up to that height is hidden
//
// The view knows only how low and how high the surface is within bins, and decides by more than rounding.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "bounds/bin_bounds.hpp"
#include "scene/sweep/horizon_hierarchy.hpp"
#include "scene/sweep/sector_profile.hpp"

namespace itin::viewshed {

class HorizonView {
 public:
  /// An axis, in grid units.
  struct Axis {
    double x = 0, y = 0;
    double base = 0, top = 0;  ///< elevations; parts that are seen below the base do not count
    double radius = 0;         ///< eyes farther away do not look
  };
  /// The axis of an eye that looks as far as there is surface, but no farther than `radius` grid units.
  static Axis axis_at(const BinBounds& bins, const Point3& eye, double radius) {
    return {eye.x, eye.y, eye.z, eye.z, std::min(radius, bins.farthest_from(eye.x, eye.y) + 1)};
  }

  /// At first the view knows of nothing that hides.
  HorizonView(const BinBounds& bins, const Axis& axis, double drop, double grazing);

  /// Whether a box lies within the axis' radius, at least in part.
  bool reaches(const BinBox& box) const;
  /// How far a box is away from the axis, in bins along columns or rows.
  double distance(const BinBox& box) const;
  /// Promises that ends will be asked about in these boxes only, and near the axis.
  void narrow(std::span<const BinBox> boxes);
  /// Looks at what hides up to `reach` bins away along columns and rows; ends farther away will be asked about later.
  /// Infinity completes the view. Throws Cancelled, after which the view is of no more use.
  void advance(double reach, const Progress& progress = NoProgress());
  /// Tells whether every end in the box up to an elevation, grid units, is certainly hidden, by what has been looked
  /// at.
  bool hides(const BinBox& box, double elevation) const;

 private:
  friend class RadialSweep;  // decides the lines that the horizon leaves
  /// A range of ends within a quadrant: between two slopes, and between two distances along.
  struct Extent {
    double from = 0, to = 0;
    double nearest = 0, farthest = 0;
    double least_drop = 0;  ///< grid units
  };
  bool hides(const Sector::Hidden& known, const Extent& ends, double elevation) const;
  std::optional<Extent> extent(const Quadrant& quadrant, const BinBox& box) const;

  Axis axis_;
  Sector::Axis sector_axis_;
  std::vector<Quadrant> quadrants_;
  std::vector<HorizonHierarchy> fans_;  ///< one for each quadrant
  double column_, row_, bin_;           ///< where the axis is, in bins, and how wide these are, grid units
};

}  // namespace itin::viewshed
