// The foliage about an eye, by direction: where lines from the eye run within it.
//
//   const FoliageAbout woods(surface, vegetation, eye, earth);
//   std::vector<FoliageAbout::Piece> pieces;
//   if (woods.along(target, pieces) || woods.along(target, section_line, pieces)) use(pieces);
//
// Lines from one eye share the triangles of vegetation in their direction, the nearest first. A bound on how high a
// triangle rises in the eye's view, and one of every few of them, leave out most of those that a line passes above.
// Lines that follow each other in azimuth find in the processor's cache what they look at.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/section_line.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// Safe for concurrent use.
class FoliageAbout {
 public:
  /// `vegetation` tells of each theme, by its number, whether it is foliage. The eye is in grid units. The surface must
  /// outlive this object. Takes about 50 bytes for each triangle of vegetation.
  FoliageAbout(const Tin& surface, const std::vector<bool>& vegetation, const Point3& eye, const Earth& earth);

  /// A part of a line within foliage, in fractions of the line's length.
  struct Piece {
    double from = 0, to = 0;
    std::uint16_t theme = 0;
    bool goes_on = false;  ///< it begins within the outline of its feature
  };
  /// Finds the pieces of the line to a target, grid units: those of profile::foliage_along(), in no order. Returns
  /// false where the line runs along an edge, of which it is a matter of rounding on which side it passes.
  /// Precondition: eye and target differ horizontally. Cost: about 15 nanoseconds for each triangle of vegetation that
  /// rises above the line.
  bool along(const Point3& target, std::vector<Piece>& pieces) const;
  /// Does the same where the line runs along edges; `exact` is the same line. Returns false where it runs within
  /// foliage along an edge that has none on its right side, as at the end of the data.
  bool along(const Point3& target, const SectionLine& exact, std::vector<Piece>& pieces) const;

 private:
  /// A triangle in the eye's view.
  struct Entry {
    double from = 0, width = 0;  ///< angles that it lies between, radians anticlockwise from east
    float nearest = 0;           ///< no part of it is nearer, grid units
    float highest = 0;           ///< no part of it rises higher, as a slope
    std::uint32_t triangle = 0;
  };
  struct Line;
  struct Sides;
  /// Where a line meets the triangles' edges, and the theme of what it meets.
  struct Crossing;
  bool is_foliage(const Triangle& triangle) const;
  Entry entry_of(std::uint32_t triangle) const;
  void list_by_direction();
  std::size_t direction_of(double angle) const;
  /// Calls visit(triangle) for all that may rise above the line, until one returns false. Returns whether none did.
  template <class Visit>
  bool for_each_triangle(const Line& line, const Visit& visit) const;
  /// Returns nothing where the line runs along one of the triangle's edges.
  std::optional<Sides> sides_of(const Line& line, const Triangle& corners) const;
  Sides exact_sides_of(const SectionLine& line, const Triangle& corners) const;
  /// Adds the piece over a triangle, if any.
  void add_piece(const Line& line, const Triangle& corners, const Sides& sides, std::vector<Piece>& pieces) const;
  Crossing crossing_at(const Line& line, std::uint32_t corner) const;
  std::optional<Piece> piece_between(const Line& line, const Crossing& in, const Crossing& out) const;

  const Tin& surface_;
  const std::vector<bool>& vegetation_;
  Point3 eye_;
  double drop_;  ///< per grid unit
  double grazing_;
  std::vector<Entry> entries_;  ///< the nearest first
  std::size_t directions_ = 1;
  BucketLists by_direction_;            ///< numbers of entries
  std::vector<float> highest_;          ///< one bound for every few entries that follow each other in a direction
  std::vector<std::size_t> first_few_;  ///< where the bounds of a direction begin
};

}  // namespace itin::viewshed
