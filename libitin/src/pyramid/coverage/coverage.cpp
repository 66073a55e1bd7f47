#include "pyramid/coverage/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>

#include "pyramid/coverage/gap_rule.hpp"
#include "pyramid/coverage/ground_edges.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

/// The fringe in mean spacings. A wider one leaves less to mend along the tiles' borders, and costs more here.
constexpr double kFringe = 16;

/// The ends of the straight runs, ascending.
std::vector<std::uint64_t> corners_of(const std::vector<Segment>& edges) {
  std::vector<std::uint64_t> corners;
  for (const Segment& s : join_collinear(edges)) {
    corners.push_back(code_of(s.a()));
    corners.push_back(code_of(s.b()));
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

GridBox widened(const GridBox& box, double margin) {
  const auto inside = [](double v) {
    return static_cast<std::int32_t>(std::clamp(v, -1.0 * kGridHalfSide, kGridHalfSide - 1.0));
  };
  return {inside(box.xmin - margin), inside(box.ymin - margin), inside(box.xmax + margin), inside(box.ymax + margin)};
}

/// The width of the fringe: some mean spacings, by which neighbouring tiles see the same surface and choose alike.
double fringe(const GridBox& box, std::size_t points) {
  const double area = (1.0 + box.xmax - box.xmin) * (1.0 + box.ymax - box.ymin);
  return std::ceil(kFringe * std::sqrt(area / static_cast<double>(points)));
}

/// The points in the box, in ascending Morton order.
std::vector<SelectedVertex> points_in(const PointIndex& index, const GridBox& box) {
  std::vector<SelectedVertex> points;
  std::vector<Leaf> leaves;
  index.leaves({}, box, leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = index.block(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (box.contains(p.x, p.y)) points.push_back({p, block->sources[k], level_of(leaf, *block, k)});
    }
  }
  return points;
}

/// Surveys a tile whose points are all posts of one lattice, with squares that are the ground; nothing for any other.
std::optional<GroundEdges> survey_lattice(const PointIndex& points, const GridBox& box, double reach,
                                          const GapRule& gaps, TileSurvey& survey) {
  // A source that bridges a step reaches at least as far, and points two steps away do not change any square.
  survey.surface.vertices = points_in(points, widened(box, 2 * reach));
  survey.posts = LatticePosts::of(survey.surface.vertices);
  return survey.posts ? ground_edges(survey.surface.vertices, *survey.posts, gaps, box) : std::nullopt;
}

GroundEdges survey_triangles(const PointIndex& points, const GridBox& box, const GapRule& gaps, TileSurvey& survey) {
  survey.surface = triangulate_region(points, Selection(Detail::tolerance(0), {0.0}, Grid{}), box);
  survey.posts = LatticePosts::of(survey.surface.vertices);
  return ground_edges(survey.surface, gaps, box);
}

std::vector<Candidacy> candidacy_of(const std::vector<SelectedVertex>& vertices, const GroundEdges& edges,
                                    const GridBox& box) {
  std::vector<Segment> segments;
  for (const GroundEdges::Edge& edge : edges.edges) segments.push_back(edge.segment);
  const std::vector<std::uint64_t> corners = corners_of(segments);
  std::vector<Candidacy> candidacy;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const bool free = edges.touched[v] && box.contains(vertices[v].point.x, vertices[v].point.y);
    const bool corner = free && std::binary_search(corners.begin(), corners.end(), code_of(vertices[v]));
    candidacy.push_back(corner ? Candidacy::kCorner : free ? Candidacy::kFree : Candidacy::kNone);
  }
  return candidacy;
}

/// The points that no ground meets, or no triangle at all: fewer than three, or all in line.
std::vector<std::uint64_t> isolated_of(const std::vector<RawPoint>& points, const TileSurvey& survey) {
  std::vector<std::uint64_t> codes, grounded, isolated;
  for (const RawPoint& p : points) codes.push_back(p.code);
  for (std::size_t v = 0; v < survey.candidacy.size(); ++v)
    if (survey.candidacy[v] != Candidacy::kNone) grounded.push_back(code_of(survey.surface.vertices[v]));
  std::set_difference(codes.begin(), codes.end(), grounded.begin(), grounded.end(), std::back_inserter(isolated));
  return isolated;
}

}  // namespace

std::vector<std::array<double, 4>> gap_bases_of(const std::vector<SourceInfo>& sources, const Grid& grid) {
  std::vector<std::array<double, 4>> bases;
  for (const SourceInfo& source : sources) {
    bases.push_back(source.gap_basis);
    for (double& component : bases.back()) component /= grid.resolution;
  }
  return bases;
}

GridBox reach_of(const CurveRange& tile) {
  const GridBox square = square_of(tile.cell);
  return tile.count == 0 ? square : widened(square, fringe(square, tile.count));
}

TileSurvey survey_tile(const WorkingIndex& index, const CurveRange& tile,
                       const std::vector<std::array<double, 4>>& gap_bases, const SourceIndex* ground_points) {
  TileSurvey survey;
  std::vector<RawPoint> own = index.read(tile);
  std::erase_if(own, [&](const RawPoint& p) {
    return p.level == kDropped || (ground_points != nullptr && !ground_points->sources().contains(p.source));
  });
  const GridBox points = box_of(own, [](const RawPoint& p) { return position_of(p.code); });
  if (points.empty()) return survey;
  const double margin = fringe(points, tile.count);
  const GridBox box = widened(points, margin);
  survey.verge = widened(points, margin / 2);
  const GapRule gaps(gap_bases);
  const double reach = gaps.reach(sources_of(own));
  const PointIndex& ground = ground_points == nullptr ? static_cast<const PointIndex&>(index) : *ground_points;
  // Ground that reaches farther does not consist of a lattice's squares, or has few of them.
  std::optional<GroundEdges> edges;
  if (2 * reach <= margin) edges = survey_lattice(ground, box, reach, gaps, survey);
  if (!edges) edges = survey_triangles(ground, box, gaps, survey);
  for (const auto& [segment, owner] : edges->edges)
    if (tile.cell.contains(owner)) survey.outline.push_back(segment);
  survey.candidacy = candidacy_of(survey.surface.vertices, *edges, box);
  survey.isolated = isolated_of(own, survey);
  return survey;
}

TileSurvey survey_surface(const WorkingIndex& index, const CurveRange& tile) {
  TileSurvey survey;
  std::vector<RawPoint> own = index.read(tile);
  std::erase_if(own, [](const RawPoint& p) { return p.level == kDropped; });
  const GridBox points = box_of(own, [](const RawPoint& p) { return position_of(p.code); });
  if (points.empty()) return survey;
  const double margin = fringe(points, tile.count);
  const GridBox box = widened(points, margin);
  survey.verge = widened(points, margin / 2);
  Selection selection(Detail::tolerance(0), {0.0}, Grid{});
  selection.leave_out(kCoverage);
  survey.surface = triangulate_region(index, selection, box);
  for (const SelectedVertex& v : survey.surface.vertices)
    survey.candidacy.push_back(box.contains(v.point.x, v.point.y) ? Candidacy::kFree : Candidacy::kNone);
  if (survey.surface.lines.empty()) survey.posts = LatticePosts::of(survey.surface.vertices);
  return survey;
}

std::vector<Segment> join_collinear(std::vector<Segment> edges) {
  std::sort(edges.begin(), edges.end());
  using End = std::pair<std::int32_t, std::int32_t>;
  std::map<End, int> arriving;
  for (const Segment& s : edges) arriving[{s.bx, s.by}] += 1;
  const auto leaving = [&](End p) {
    const auto first = std::lower_bound(edges.begin(), edges.end(), p, [](const Segment& s, End e) {
      return End{s.ax, s.ay} < e;
    });
    auto last = first;
    while (last != edges.end() && End{last->ax, last->ay} == p) ++last;
    return std::pair{first, last};
  };
  /// The only edge onwards through p, if it goes straight on from s.
  const auto onwards = [&](const Segment& s) -> const Segment* {
    const End p{s.bx, s.by};
    const auto [first, last] = leaving(p);
    if (last - first != 1 || arriving[p] != 1) return nullptr;
    const Position a = s.a(), b = s.b(), c{first->bx, first->by};
    const bool forward =
        (std::int64_t{b.x} - a.x) * (std::int64_t{c.x} - b.x) + (std::int64_t{b.y} - a.y) * (std::int64_t{c.y} - b.y) >
        0;
    return forward && orientation(a, b, c) == 0 ? &*first : nullptr;
  };
  std::vector<std::uint8_t> continued(edges.size(), 0);
  for (const Segment& s : edges) {
    if (const Segment* next = onwards(s)) continued[static_cast<std::size_t>(next - edges.data())] = 1;
  }
  std::vector<Segment> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (continued[i]) continue;  // a straight run starts elsewhere; it cannot be a closed loop
    Segment joined = edges[i];
    for (const Segment* next = onwards(edges[i]); next != nullptr; next = onwards(*next))
      joined.bx = next->bx, joined.by = next->by;
    result.push_back(joined);
  }
  return result;
}

}  // namespace itin
