// The full surface that greedy insertion approximates (greedy_insertion.hpp), where its vertices are posts of a
// lattice, perhaps with gaps.
//
//   if (auto ground = LatticeGround::of(vertices, candidacy)) GreedyInsertion greedy(*ground, candidacy, tolerances);
//
// Posts within a coarse face are found row by row, and crossings with the sides of the lattice's triangles by
// arithmetic (lattice_crossings.hpp). Sides of which a post is missing are passed over: beside gaps, full triangles
// have other edges, too, which only verification sees.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "pyramid/greedy_insertion.hpp"
#include "pyramid/lattice_crossings.hpp"

namespace itin {

class LatticeGround {
 public:
  /// Nothing where any candidate lies off the lattice, or few have neighbours there. The vertices must outlive it.
  static std::optional<LatticeGround> of(std::span<const SelectedVertex> vertices,
                                         std::span<const Candidacy> candidacy);

  std::size_t size() const { return vertices_.size(); }
  const GridPoint& point(std::uint32_t v) const { return vertices_[v].point; }

  void begin(const CoarseTriangulation&, std::span<const std::uint32_t>) {}
  void take(std::span<const CoarseFace>, std::uint32_t) {}
  void settle(const TraitsPoint&, std::span<const StarFace>) {}

  WorstPoint worst_point(CoarseFace face) const;

  /// At a crossing, the nearer post of the side, or the other one, or a post opposite.
  template <class Worst>
  void compare_edge(std::uint32_t a, std::uint32_t b, Worst& worst) const {
    const double from = point(a).z, rise = static_cast<double>(point(b).z) - from;
    for_each_crossing(place_of(point(a)), place_of(point(b)), columns_, rows_,
                      [&](const LatticeSide& side, double part, double along) {
                        const std::int32_t u = height(side.u), v = height(side.v);
                        if (u == kMissing || v == kMissing) return;
                        const double fine = u + part * (static_cast<double>(v) - u);
                        const double error = std::abs(fine - (from + along * rise));
                        if (!worst.asks_for(error)) return;
                        const bool nearer_u = part <= 0.5;
                        worst.offer(error, {vertex(nearer_u ? side.u : side.v), vertex(nearer_u ? side.v : side.u),
                                            vertex(side.left), vertex(side.right)});
                      });
  }

 private:
  static constexpr std::int32_t kMissing = std::numeric_limits<std::int32_t>::min();

  explicit LatticeGround(std::span<const SelectedVertex> vertices) : vertices_(vertices) {}
  bool place(std::span<const Candidacy> candidacy);
  std::size_t count_with_neighbours() const;

  /// A multiplication is quicker than a division. The factors are a little too great, so that none is rounded down.
  template <class Point>
  LatticePlace place_of(const Point& p) const {
    const double east = static_cast<double>(p.x) - west_, north = static_cast<double>(p.y) - south_;
    return {static_cast<std::int64_t>(east * columns_per_unit_), static_cast<std::int64_t>(north * rows_per_unit_)};
  }
  std::size_t post(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  std::int32_t height(const LatticePlace& place) const { return heights_[post(place.column, place.row)]; }
  /// kNoVertex where there is none, and beyond the lattice.
  std::uint32_t vertex(const LatticePlace& place) const;

  std::span<const SelectedVertex> vertices_;
  std::int64_t columns_ = 0, rows_ = 0;
  std::int32_t west_ = 0, south_ = 0;  ///< of the first post
  double columns_per_unit_ = 0, rows_per_unit_ = 0;
  std::vector<std::int32_t> heights_;   ///< by post, grid units; kMissing where no candidate is
  std::vector<std::uint32_t> numbers_;  ///< by post: of its vertex
};

}  // namespace itin
