// The leaves of a quadtree that a triangle lies in, decided exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <itin/box_of.hpp>

#include "geometry/cell_about.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

using Corners = std::array<Position, 3>;  ///< counterclockwise

/// Tells whether a triangle and a closed box share more than a border.
bool shares_area(const Corners& triangle, const GridBox& box);

class LeafCover {
 public:
  /// Takes the leaves of one tree along the curve. They must include all leaves that meet the triangles asked about.
  explicit LeafCover(std::vector<Leaf> leaves) : leaves_(std::move(leaves)) {}

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Calls on_leaf(i) for each leaf whose square shares area with the triangle, and on_gap(cell) for cells that share
  /// area with it and have no leaf.
  template <class OnLeaf, class OnGap>
  void visit(const Corners& triangle, const OnLeaf& on_leaf, const OnGap& on_gap) const;

 private:
  using Number = std::ptrdiff_t;
  /// Returns the first leaf that ends after a code.
  Number first_after(std::uint64_t code) const {
    const auto ends_by = [](const Leaf& leaf, std::uint64_t c) { return leaf.cell.end() <= c; };
    return std::lower_bound(leaves_.begin(), leaves_.end(), code, ends_by) - leaves_.begin();
  }
  /// Visits the leaves [first, last) in the cell, or the only one of them, which holds the cell.
  template <class OnLeaf, class OnGap>
  void visit_in(const Cell& cell, Number first, Number last, const Corners& triangle, const OnLeaf& on_leaf,
                const OnGap& on_gap) const;

  std::vector<Leaf> leaves_;
};

template <class OnLeaf, class OnGap>
void LeafCover::visit(const Corners& triangle, const OnLeaf& on_leaf, const OnGap& on_gap) const {
  const Cell cell = cell_about(box_of(triangle));
  const Number first = first_after(cell.code);
  const bool within =
      first < static_cast<Number>(leaves_.size()) && leaves_[static_cast<std::size_t>(first)].cell.contains(cell);
  visit_in(cell, first, within ? first + 1 : first_after(cell.end()), triangle, on_leaf, on_gap);
}

template <class OnLeaf, class OnGap>
void LeafCover::visit_in(const Cell& cell, Number first, Number last, const Corners& triangle, const OnLeaf& on_leaf,
                         const OnGap& on_gap) const {
  if (!shares_area(triangle, square_of(cell))) return;
  if (first == last) return on_gap(cell);
  if (leaves_[static_cast<std::size_t>(first)].cell.contains(cell)) return on_leaf(static_cast<std::size_t>(first));
  for (int i = 0; i < 4; ++i) {
    const Cell child = cell.child(i);
    const Number end = i == 3 ? last : std::min(last, first_after(child.end()));
    visit_in(child, first, end, triangle, on_leaf, on_gap);
    first = end;
  }
}

}  // namespace itin
