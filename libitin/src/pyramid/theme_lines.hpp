// Lines to be stored: they are planar already, and have yet to be laid on the ground.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/theme.hpp>

#include "features/mesh/ground_border.hpp"
#include "features/part_vertices.hpp"
#include "features/plan/planar.hpp"
#include "features/raised_theme.hpp"
#include "pyramid/points/source_index.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// A part of a raised theme, whose lines are planar with all others.
struct PlacedPart {
  ThemePart part;
  int rank = 0;  ///< it takes the ground of parts with a greater rank
  std::uint16_t source = 0;
  std::vector<PartVertex> vertices;  ///< with heights of its own, in Morton order
  std::vector<GridPolygon> masks;
  std::vector<std::uint32_t> mask_clusters;  ///< kNoCluster for all where no level leaves the part out
  std::vector<FeatureReach> reaches;
};

struct ThemeVertex {
  std::uint32_t theme;  ///< from 0
  std::uint64_t code;   ///< Morton
  friend auto operator<=>(const ThemeVertex&, const ThemeVertex&) = default;
};

/// The lines of all themes; owner i is theme i + 1. The parts of raised themes are numbered after the themes.
struct ThemeLines {
  PlanarLines lines;
  std::vector<bool> terrain;           ///< by theme: whether its lines are part of the full surface
  std::vector<ThemeKind> kinds;        ///< by theme
  std::vector<bool> raised;            ///< by theme: whether its features are parts, and its own lines keep the ground
  std::vector<std::uint16_t> sources;  ///< by vertex: the source that it comes from
  std::vector<PlacedPart> parts;
  /// The ends of lines that keep the ground, ascending: all vertices of the full surface or of the theme's parts.
  std::vector<ThemeVertex> ground_ends;
  std::vector<PlacedBorder> borders;  ///< the borders of the ground kept so

  std::size_t themes() const { return terrain.size(); }
  bool is_raised(const PlanarEdge& e) const { return e.owner >= themes(); }
  /// Whether an edge is one of the full surface about features, which changes nothing where the features are absent.
  bool keeps_ground(const PlanarEdge& e) const { return !is_raised(e) && raised[e.owner]; }
  /// Whether an edge lies on the ground.
  bool lies(const PlanarEdge& e) const { return !is_raised(e) && !raised[e.owner]; }
  /// The numbers of the vertices of the terrain's lines, ascending: points of the full surface.
  std::vector<std::uint32_t> terrain_vertices() const;
  /// Whether no line lies on the ground.
  bool empty() const {
    return std::none_of(lines.edges.begin(), lines.edges.end(), [&](const PlanarEdge& e) { return lies(e); });
  }
};

/// The lines so far as they lie on the ground.
struct PlacedLines {
  std::vector<Segment> terrain;             ///< part of the full surface; their ends are points of the index
  std::vector<Segment> features;            ///< lines on the full surface
  std::vector<SegmentFeature> of_features;  ///< features that `terrain` and `features` belong to; ascending
  std::vector<std::uint64_t> feature_ends;  ///< ascending Morton codes: where a theme's line goes on as another feature
  std::vector<Segment> raised;              ///< lines of parts
  std::vector<Segment> ground;              ///< edges of the full surface about lines of parts, at level 0
  std::vector<std::uint64_t> ends;          ///< ends of `terrain` and `features`, ascending Morton codes
  std::vector<std::uint64_t> on_outline;    ///< the ends that lie on the ground's outline
  std::vector<std::uint64_t> strays;        ///< vertices of terrain lines beyond the ground
  std::uint64_t left_out = 0;               ///< segments beyond the ground, or that leave it
};

/// An edge of a part as a segment.
Segment raised_segment(const PlanarEdge& edge, const ThemeLines& lines);
/// The segments of the parts of raised themes, which lie on the ground already.
std::vector<Segment> raised_segments(const ThemeLines& lines);
Segment segment_of(const BorderEdge& border);
/// The segments that keep the ground about raised features.
std::vector<Segment> ground_segments(const ThemeLines& lines);
/// Vertices that lines which keep the ground got from crossing other lines, ascending. They may be vertices of the full
/// surface.
std::vector<ThemeVertex> crossings_of_ground(const ThemeLines& lines);

/// Leaves out every segment that is not wholly on the ground of the given sources, whose outline is `outline`.
/// `gap_bases` in grid units. The index must have no segments yet.
PlacedLines place_lines(const ThemeLines& lines, const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                        const Sources& ground, const std::vector<std::array<double, 4>>& gap_bases,
                        const std::vector<Segment>& outline, Progress& progress);

/// The full surface's heights at the positions (ascending Morton codes) on the ground where it has no vertex; positions
/// where it has one are left out. `ground` has the full surface's points and no others.
std::vector<GridPoint> drape(const std::vector<std::uint64_t>& codes, const PointIndex& ground, Progress& progress);

}  // namespace itin
