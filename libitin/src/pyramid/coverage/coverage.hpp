// Where there is ground: the union of those triangles of the plain Delaunay triangulation of all points whose edges do
// not exceed the gaps of their sources (SourceInfo::gap_basis). Its outline, voids included, becomes the built-in
// constraint theme, so that nothing is ever triangulated into ground across a hole, at any level.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/store.hpp>

#include "pyramid/greedy/greedy.hpp"
#include "pyramid/greedy/lattice_posts.hpp"
#include "pyramid/points/source_index.hpp"
#include "pyramid/points/working_index.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// Returns SourceInfo::gap_basis of each source, in grid units.
std::vector<std::array<double, 4>> gap_bases_of(const std::vector<SourceInfo>& sources, const Grid& grid);

/// The full surface about one tile, and the part of the coverage that the tile's own points have.
struct TileSurvey {
  /// Every triangle about the tile's points, ground or not; perhaps no triangles where the points are posts of a
  /// lattice.
  RegionMesh surface;
  std::optional<LatticePosts> posts;    ///< the surface's vertices, where they are a lattice's posts and no lines exist
  GridBox verge;                        ///< the tile's points and half the fringe seen around them
  std::vector<Candidacy> candidacy;     ///< per vertex: corners of the outline are kCorner, isolated points kNone
  std::vector<Segment> outline;         ///< edges with ground to the left, each in one tile only
  std::vector<std::uint64_t> isolated;  ///< Morton codes of the tile's points that no ground triangle has
};

/// A box that holds all that the survey of a tile depends on, except the positions of far away points.
GridBox reach_of(const CurveRange& tile);

/// Surveys a tile. `gap_bases` holds a basis per source, in grid units. If `ground` is given, other points than its own
/// are passed over: they are neither ground nor isolated. The index must have no segments yet, and nothing may be
/// dropped meanwhile.
TileSurvey survey_tile(const WorkingIndex& index, const CurveRange& tile,
                       const std::vector<std::array<double, 4>>& gap_bases, const SourceIndex* ground = nullptr);

/// The full surface about one tile, without outline, where lines are part of the surface and the tile's points are
/// known to be ground. There are triangles across voids, for greedy insertion walks straight.
TileSurvey survey_surface(const WorkingIndex& index, const CurveRange& tile);

/// Returns one segment for each maximal straight run of directed edges, in a canonical order. Their ends are the
/// corners.
std::vector<Segment> join_collinear(std::vector<Segment> edges);

}  // namespace itin
