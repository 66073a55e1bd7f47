// Tells in which of many polygons a position lies, borders included. It is made for polygons that overlap little.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "features/plan/plan_overlay.hpp"
#include "features/plan/polygon_sides.hpp"

namespace itin {

/// An index that does not need the polygons once made. Safe for concurrent use. A look-up costs O(1) away from borders,
/// and at borders time proportional to the edges nearby.
class MaskIndex {
 public:
  explicit MaskIndex(std::span<const GridPolygon> polygons);

  /// The first polygon that has the position inside or on its border.
  std::optional<std::uint32_t> at(Position p) const;
  /// Whether a polygon has the position inside, not on its border.
  bool strictly_inside(Position p) const;
  /// Whether a polygon has the place inside, as PolygonSides::encloses() tells.
  bool encloses(Point2 p) const;
  /// The first polygon that has the middle between two positions inside, as PolygonSides::encloses_middle() tells.
  std::optional<std::uint32_t> about_middle(Position a, Position b) const;
  bool middle_inside(Position a, Position b) const { return about_middle(a, b).has_value(); }

 private:
  std::uint64_t bucket(std::int64_t x, std::int64_t y) const;
  void add(std::uint32_t number, const GridBox& box);
  /// The first polygon near (x, y), floored to the grid, that the test holds for.
  template <class Test>
  std::optional<std::uint32_t> first_near(std::int64_t x, std::int64_t y, const Test& test) const;

  std::vector<PolygonSides> polygons_;
  std::int64_t side_ = 64;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> buckets_;  ///< the polygons whose boxes meet a bucket
};

GridBox box_about(const GridPolygon& polygon);

}  // namespace itin
