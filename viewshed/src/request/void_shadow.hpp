// The part of the ground that lies behind ground without data as an eye sees it: beyond an edge where the surface
// begins anew.
//
//   const VoidShadow shadow(surface.rim(), eye.units);
//   if (shadow.holds(target.x, target.y)) ...           // hidden under NoData::kBlock
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/lattice_tin.hpp>
#include <viewshed/result.hpp>

#include "line/cell_tiles.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

class VoidShadow {
 public:
  /// Finds the shadow of an eye, in grid units. Places in it are hidden under kBlock and undecided under kUnknown.
  /// Cost: the number of edges; if any faces away from the eye, each counts as often as the sectors of the horizon it
  /// spans.
  VoidShadow(const std::vector<RimEdge>& rim, const Point3& eye, NoData rule = NoData::kBlock);

  /// Tells whether the line from the eye to a place, grid units, crosses ground without data and comes back to the
  /// surface, be it at the place itself. Returns false for the eye's own place. The eye and the place lie on the
  /// surface. Cost: the edges of one sector.
  bool holds(double x, double y) const;

  /// Returns what a visible cell in the shadow becomes: Verdict::kHidden, or Verdict::kUndecided under kUnknown.
  Verdict shaded() const { return shaded_; }

  /// Sets each of the tile's cells that is Verdict::kVisible and lies in the shadow to shaded().
  void apply_to(const TileCentres& centres, TileValues<Verdict>& values) const;

 private:
  /// A vector from the eye, grid units.
  struct Vector {
    double x = 0, y = 0;
    friend bool operator==(const Vector&, const Vector&) = default;
  };
  /// An edge of the rim. The surface is to the left of from -> to.
  struct Edge {
    Vector from, to;
  };
  using Numbers = std::vector<std::uint32_t>;

  static double cross(const Vector& a, const Vector& b);
  static double dot(const Vector& a, const Vector& b);
  static bool reaches(const Vector& line, const Vector& place);
  static std::size_t sector_of(const Vector& place);
  bool comes_from_void(const Numbers& edges, const Vector& corner) const;

  Point3 eye_;
  Verdict shaded_;
  std::vector<Edge> edges_;       ///< empty where no edge faces away
  std::vector<Numbers> sectors_;  ///< clockwise from the south; empty where edges_ is
};

/// Returns about the memory of a shadow of a rim of so many edges, some of which face away.
std::uint64_t bytes_of_shadow(std::size_t edges);

/// Returns the shadow of ground without data beyond this rim, as seen from the eye; null where the shadow changes
/// nothing in the result.
std::shared_ptr<const VoidShadow> shadow_of(const Eye& eye, const std::vector<RimEdge>& rim, const Result& result);

/// Tells whether a sight line from the position to a place within the radius, metres, may cross ground without data.
bool may_cross_voids(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double radius);
/// Tells the same of lines to places in the box alone; the surface need not reach beyond these.
bool may_cross_voids(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double radius,
                     const Box& ends);
/// Finds out whether sight lines of the result's request may cross ground without data. `rim` is where the surface
/// ends, in these units.
void find_voids(const Grid& units, const std::vector<RimEdge>& rim, Result& result);

}  // namespace itin::viewshed
