// Finds where the ground of a surface ends: the edges of its ground triangles (gap_rule.hpp) with nothing beyond.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pyramid/coverage/gap_rule.hpp"
#include "pyramid/greedy/lattice_posts.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

struct GroundEdges {
  struct Edge {
    Segment segment;      ///< with the ground to its left
    std::uint64_t owner;  ///< the end that is first on the curve, whose tile the edge belongs to
  };
  std::vector<Edge> edges;
  std::vector<std::uint8_t> touched;  ///< vertices that ground meets
};

/// The ground edges with an end in the box. The surface has all triangles about vertices in the box.
GroundEdges ground_edges(const RegionMesh& surface, const GapRule& gaps, const GridBox& box);

/// Returns the ground edges where the surface is the Delaunay triangulation of these vertices, which are posts of a
/// lattice: all points within two of its steps about the box. Nothing where triangles other than halves of the
/// lattice's squares may be ground.
std::optional<GroundEdges> ground_edges(std::span<const SelectedVertex> vertices, const LatticePosts& posts,
                                        const GapRule& gaps, const GridBox& box);

}  // namespace itin
