// The full surface that greedy insertion approximates (greedy_insertion.hpp), where its vertices are posts of a
// lattice, perhaps with gaps.
//
// Posts within a coarse face are found row by row, and crossings with the sides of the lattice's triangles by
// arithmetic (lattice_crossings.hpp). A side with a missing post is passed over. Beside gaps, full triangles have other
// edges, too, which only verification sees.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pyramid/difference/lattice_crossings.hpp"
#include "pyramid/greedy/greedy_insertion.hpp"
#include "pyramid/greedy/lattice_posts.hpp"

namespace itin {

class LatticeGround {
 public:
  /// `posts` must be the posts of `vertices`. All arguments must outlive it.
  LatticeGround(const std::vector<SelectedVertex>& vertices, const LatticePosts& posts,
                std::span<const Candidacy> candidacy);

  const std::vector<SelectedVertex>& vertices() const { return vertices_; }

  void begin(GrowingMesh&, std::span<const std::uint32_t>) {}
  void take(std::span<const std::uint32_t>, std::uint32_t) {}
  void assign_to_star(const PlaneMesh&, std::span<const std::uint32_t>) {}

  WorstPoint worst_point(std::uint32_t face, const std::array<std::uint32_t, 3>& corners) const;

  /// Offers, at a crossing, the nearer post of the side, or the other one, or a post opposite.
  template <class Worst>
  void compare_edge(std::uint32_t a, std::uint32_t b, Worst& worst) const {
    const double from = point(a).z, rise = static_cast<double>(point(b).z) - from;
    for_each_crossing(posts_.place_of(point(a)), posts_.place_of(point(b)), posts_.columns(), posts_.rows(),
                      [&](const LatticeSide& side, double part, double along) {
                        const std::int32_t u = height(side.u), v = height(side.v);
                        if (u == kMissing || v == kMissing) return;
                        const double fine = u + part * (static_cast<double>(v) - u);
                        const double error = std::abs(fine - (from + along * rise));
                        if (!worst.asks_for(error)) return;
                        const bool nearer_u = part <= 0.5;
                        const LatticePlace &nearer = nearer_u ? side.u : side.v, &farther = nearer_u ? side.v : side.u;
                        worst.offer(error, {posts_.vertex(nearer), posts_.vertex(farther), posts_.vertex(side.left),
                                            posts_.vertex(side.right)});
                      });
  }

 private:
  static constexpr std::int32_t kMissing = std::numeric_limits<std::int32_t>::min();

  const GridPoint& point(std::uint32_t v) const { return vertices_[v].point; }
  std::int32_t height(const LatticePlace& place) const { return heights_[posts_.index(place.column, place.row)]; }

  const std::vector<SelectedVertex>& vertices_;
  const LatticePosts& posts_;
  std::vector<std::int32_t> heights_;  ///< by place, grid units; kMissing where no candidate is
  std::vector<std::uint8_t> spare_;    ///< by place; empty where no candidate is spare
};

}  // namespace itin
