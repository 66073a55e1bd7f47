#include "pyramid/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/gap_rule.hpp"
#include "pyramid/whole_lattice.hpp"
#include "triangulate/read_once.hpp"
#include "triangulate/region.hpp"

namespace itin {

namespace {

/// Mean spacings. A wider fringe leaves less to mend along the tiles' borders, and costs more here.
constexpr double kFringe = 16;

Segment segment(const RegionMesh& region, std::uint32_t from, std::uint32_t to) {
  const GridPoint &a = region.vertices[from].point, &b = region.vertices[to].point;
  return {a.x, a.y, b.x, b.y};
}

/// Ends of the straight runs, ascending.
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

/// Some mean spacings, by which neighbouring tiles see the same surface and choose alike.
double fringe(const GridBox& box, std::size_t points) {
  const double area = (1.0 + box.xmax - box.xmin) * (1.0 + box.ymax - box.ymin);
  return std::ceil(kFringe * std::sqrt(area / static_cast<double>(points)));
}

bool lies_in(const GridBox& box, const SelectedVertex& v) {
  return box.contains(v.point.x, v.point.y);
}

/// Where the ground of a surface ends, as far as all triangles about it are known.
struct GroundEdges {
  struct Edge {
    Segment segment;
    std::uint64_t owner;  ///< it belongs to the tile of this one of its ends, the first on the curve
  };
  std::vector<Edge> segments;
  std::vector<std::uint8_t> touched;  ///< vertices that ground meets
};

GroundEdges ground_edges(const RegionMesh& region, const GapRule& gaps, const GridBox& box) {
  std::vector<std::uint8_t> ground;
  for (const auto& [a, b, c] : region.mesh.triangles)
    ground.push_back(gaps.ground(region.vertices[a], region.vertices[b], region.vertices[c]));
  GroundEdges edges{{}, std::vector<std::uint8_t>(region.vertices.size(), 0)};
  for (std::size_t t = 0; t < ground.size(); ++t) {
    if (!ground[t]) continue;
    for (int i = 0; i < 3; ++i) {
      edges.touched[region.mesh.triangles[t][i]] = 1;
      const std::uint32_t n = region.mesh.neighbours[t][i];
      if (n != kNoTriangle && ground[n]) continue;
      const std::uint32_t from = region.mesh.triangles[t][(i + 1) % 3], to = region.mesh.triangles[t][(i + 2) % 3];
      // All triangles at a vertex in the box are known, so its edges are; farther away some neighbours are missing.
      if (!lies_in(box, region.vertices[from]) && !lies_in(box, region.vertices[to])) continue;
      const std::uint64_t owner = std::min(code_of(region.vertices[from]), code_of(region.vertices[to]));
      edges.segments.push_back({segment(region, from, to), owner});
    }
  }
  return edges;
}

/// What a box and the squares that meet it have, if the full surface there is a lattice without gaps and all of it is
/// ground.
struct WholeGround {
  std::vector<SelectedVertex> posts;  ///< in ascending Morton order
  GroundEdges edges;
};

/// In ascending Morton order.
std::vector<SelectedVertex> points_in(const PointIndex& index, const GridBox& box) {
  std::vector<SelectedVertex> points;
  std::vector<Leaf> leaves;
  index.leaves(0, box, leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = index.block(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (box.contains(p.x, p.y)) points.push_back({p, block->sources[k], level_of(leaf, *block, k)});
    }
  }
  return points;
}

/// Whether all triangles of the lattice are ground, as the sources of all posts bridge all of their edges.
bool is_all_ground(const WholeLattice& lattice, const std::vector<SelectedVertex>& posts, const GapRule& gaps) {
  const Position first = lattice.position({0, 0}), next = lattice.position({1, 1});
  const double x = static_cast<double>(next.x) - first.x, y = static_cast<double>(next.y) - first.y;
  std::vector<std::uint16_t> sources;
  for (const SelectedVertex& v : posts)
    if (sources.empty() || sources.back() != v.source) sources.push_back(v.source);
  sort_unique(sources);
  return std::all_of(sources.begin(), sources.end(), [&](std::uint16_t source) {
    return gaps.bridges(source, x, 0) && gaps.bridges(source, 0, y) && gaps.bridges(source, x, -y);
  });
}

/// Along those sides of the lattice where all ground ends, with the ground to the left.
std::vector<GroundEdges::Edge> edges_of(const WholeLattice& lattice, const GridBox& all) {
  using Place = WholeLattice::Place;
  std::vector<GroundEdges::Edge> edges;
  const auto add = [&](Place from, Place to) {
    const Position a = lattice.position(from), b = lattice.position(to);
    edges.push_back({{a.x, a.y, b.x, b.y}, std::min(code_of(a), code_of(b))});
  };
  const GridBox own = lattice.bounds();
  const std::int64_t east = lattice.columns() - 1, north = lattice.rows() - 1;
  for (std::int64_t c = 0; c < east; ++c) {
    if (own.ymin == all.ymin) add({c, 0}, {c + 1, 0});
    if (own.ymax == all.ymax) add({c + 1, north}, {c, north});
  }
  for (std::int64_t r = 0; r < north; ++r) {
    if (own.xmin == all.xmin) add({0, r + 1}, {0, r});
    if (own.xmax == all.xmax) add({east, r}, {east, r + 1});
  }
  return edges;
}

/// The index must have no segments.
std::optional<WholeGround> whole_ground(const WorkingIndex& index, const GridBox& box, const GapRule& gaps) {
  const ReadOnce points(index);
  const auto lattice = WholeLattice::about(points, box);
  if (!lattice) return std::nullopt;
  WholeGround ground{points_in(points, lattice->bounds()), {edges_of(*lattice, index.bounds()), {}}};
  if (!is_all_ground(*lattice, ground.posts, gaps)) return std::nullopt;
  ground.edges.touched.assign(ground.posts.size(), 1);
  return ground;
}

std::vector<Candidacy> candidacy_of(const std::vector<SelectedVertex>& vertices, const GroundEdges& edges,
                                    const GridBox& box) {
  std::vector<Segment> segments;
  for (const GroundEdges::Edge& edge : edges.segments) segments.push_back(edge.segment);
  const std::vector<std::uint64_t> corners = corners_of(segments);
  std::vector<Candidacy> candidacy;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const bool free = edges.touched[v] && lies_in(box, vertices[v]);
    const bool corner = free && std::binary_search(corners.begin(), corners.end(), code_of(vertices[v]));
    candidacy.push_back(corner ? Candidacy::kCorner : free ? Candidacy::kFree : Candidacy::kNone);
  }
  return candidacy;
}

/// Points that no ground meets, or no triangle at all: fewer than three, or all in line.
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
  GroundEdges edges;
  if (auto whole = ground_points == nullptr ? whole_ground(index, box, gaps) : std::nullopt) {
    survey.surface.vertices = std::move(whole->posts);
    edges = std::move(whole->edges);
  } else {
    const Selection everything(Detail::tolerance(0), {0.0}, Grid{});
    survey.surface = ground_points == nullptr ? triangulate_region(index, everything, box)
                                              : triangulate_region(*ground_points, everything, box);
    edges = ground_edges(survey.surface, gaps, box);
  }
  for (const auto& [segment, owner] : edges.segments)
    if (tile.cell.contains(owner)) survey.outline.push_back(segment);
  survey.candidacy = candidacy_of(survey.surface.vertices, edges, box);
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
