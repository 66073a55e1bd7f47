// Greedy insertion (Garland and Heckbert 1995) as a Delaunay pyramid (De Floriani 1989), for one tile's points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pyramid/greedy/lattice_posts.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// The part that a vertex takes in greedy insertion.
enum class Candidacy : std::uint8_t {
  kNone,    ///< beyond the fringe, or isolated
  kFree,    ///< gets a level, in the fringe only a proposed one
  kSpare,   ///< is taken only where no free vertex would do
  kCorner,  ///< belongs to the coarsest level from the start
};

/// Returns the level of each vertex of `fine`, the full surface about the tile: the coarsest whose triangulation needs
/// it. So the Delaunay triangulation of the candidates of levels >= k differs from `fine` by at most tolerances[k], at
/// every candidate and along every coarse edge, for each k >= 1. (Along an edge the difference is greatest where it
/// crosses fine edges.) The levels are a proposal, which does not know the neighbouring tiles' choice; certify.hpp has
/// the last word.
///
/// Vertices that have a level in `fine` keep it, or get a coarser one.
///
/// `tolerances` are in grid units, ascending, the first one 0. Levels finer than `finest` stay as they are. Ties go to
/// the first vertex in order. O(n log n) expected.
std::vector<std::uint8_t> greedy_levels(const RegionMesh& fine, std::span<const Candidacy> candidacy,
                                        std::span<const double> tolerances, std::size_t finest = 1);

/// Returns the levels where the full surface is the Delaunay triangulation of these vertices, which are posts of a
/// lattice. Needs no triangles. Edges of the full surface that are no sides of the lattice's triangles, as beside gaps,
/// are passed over.
std::vector<std::uint8_t> greedy_levels(const std::vector<SelectedVertex>& vertices, const LatticePosts& posts,
                                        std::span<const Candidacy> candidacy, std::span<const double> tolerances,
                                        std::size_t finest = 1);

}  // namespace itin
