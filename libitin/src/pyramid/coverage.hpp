// Where there is ground: the union of those triangles of the plain Delaunay triangulation of all points whose edges do
// not exceed the gaps of their sources (SourceInfo::gap_basis). Its outline, voids included, becomes the built-in
// constraint theme, so that nothing is ever triangulated into ground across a hole, at any level.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/store.hpp>

#include "pyramid/greedy.hpp"
#include "pyramid/lattice_posts.hpp"
#include "pyramid/source_index.hpp"
#include "pyramid/working_index.hpp"
#include "triangulate/region.hpp"

namespace itin {

/// By source: SourceInfo::gap_basis in grid units.
std::vector<std::array<double, 4>> gap_bases_of(const std::vector<SourceInfo>& sources, const Grid& grid);

/// The full surface about one tile, and what its own points have of the coverage.
struct TileSurvey {
  /// Every triangle about the tile's points, ground or not; perhaps no triangles where these are posts of a lattice.
  RegionMesh surface;
  std::optional<LatticePosts> posts;    ///< its vertices, where they are those of a lattice, and no lines are there
  GridBox verge;                        ///< the tile's points and half the fringe seen around them
  std::vector<Candidacy> candidacy;     ///< per vertex: corners of the outline are kCorner, isolated points kNone
  std::vector<Segment> outline;         ///< edges with ground to the left, each in one tile only
  std::vector<std::uint64_t> isolated;  ///< the tile's points of no ground triangle, as Morton codes
};

/// A box that holds all that the survey of a tile depends on, but for the positions of far away points.
GridBox reach_of(const CurveRange& tile);

/// `gap_bases` per source, grid units. Points other than those of `ground`, if given, are passed over: they are neither
/// ground nor isolated. The index must have no segments yet, and nothing dropped meanwhile.
TileSurvey survey_tile(const WorkingIndex& index, const CurveRange& tile,
                       const std::vector<std::array<double, 4>>& gap_bases, const SourceIndex* ground = nullptr);

/// The full surface about one tile where lines are part of it, and its points are known to be ground: without outline.
/// There are triangles across voids, for greedy insertion walks straight.
TileSurvey survey_surface(const WorkingIndex& index, const CurveRange& tile);

/// One segment for each maximal straight run of directed edges, in a canonical order. Their ends are the corners.
std::vector<Segment> join_collinear(std::vector<Segment> edges);

}  // namespace itin
