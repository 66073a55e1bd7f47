// Which of many polygons a position lies in, borders included. For polygons that overlap little.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "features/plan_overlay.hpp"

namespace itin {

/// Refers to the polygons, which must outlive it. Safe for concurrent use. A look-up costs O(1) away from borders and
/// O(n) of a polygon's n edges at them.
class MaskIndex {
 public:
  explicit MaskIndex(std::span<const GridPolygon> polygons);

  /// The first polygon that has the position inside or on its border.
  std::optional<std::uint32_t> at(Position p) const;
  /// The first polygon that has the middle between two positions strictly inside, as floating point has it.
  std::optional<std::uint32_t> about_middle(Position a, Position b) const;
  bool middle_inside(Position a, Position b) const { return about_middle(a, b).has_value(); }

 private:
  struct Entry {
    std::uint32_t polygon;
    bool whole;  ///< the bucket lies in the polygon, far from its border
  };
  std::uint64_t bucket(std::int64_t x, std::int64_t y) const;
  void add(std::uint32_t polygon);
  const std::vector<Entry>* entries(std::int64_t x, std::int64_t y) const;

  std::span<const GridPolygon> polygons_;
  std::int64_t side_ = 64;
  std::unordered_map<std::uint64_t, std::vector<Entry>> buckets_;
};

GridBox box_about(const GridPolygon& polygon);

}  // namespace itin
