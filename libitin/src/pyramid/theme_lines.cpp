#include "pyramid/theme_lines.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "features/plan/hot_pixel.hpp"
#include "geometry/cell_about.hpp"
#include "pyramid/coverage/grounded.hpp"
#include "pyramid/difference/points_in_triangles.hpp"
#include "store/points_of_leaves.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

Selection everything() {
  return Selection(Detail::tolerance(0), {0.0}, Grid{});
}

using Codes = std::vector<std::uint64_t>;

/// The part of ascending codes that lies in a cell.
std::span<const std::uint64_t> in_cell(const Codes& codes, const Cell& cell) {
  const auto first = std::lower_bound(codes.begin(), codes.end(), cell.code);
  return {first, std::lower_bound(first, codes.end(), cell.end())};
}

/// Puts together what `of_run` returns for the numbers below `runs`, in order.
template <class T, class OfRun>
std::vector<T> joined_runs(std::size_t runs, const char* stage, Progress& progress, const OfRun& of_run) {
  std::vector<std::vector<T>> found(runs);
  std::atomic<std::size_t> done = 0;
  parallel_for(runs, [&](std::size_t i) {
    progress.throw_if_cancelled();
    found[i] = of_run(i);
    progress.report(stage, static_cast<double>(++done) / static_cast<double>(runs));
  });
  std::vector<T> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Tells how segments whose ends lie on the ground relate to its outline.
class OutlineTest {
 public:
  OutlineTest(const std::vector<Segment>& outline, const std::vector<Segment>& segments) : outline_(outline) {
    std::vector<Segment> all = outline;
    all.insert(all.end(), segments.begin(), segments.end());
    for_each_edge_leaf(std::move(all), [&](const Cell&, const std::vector<Segment>& near) {
      for (const Segment& border : near) {
        if (border.theme != kCoverage) continue;
        for (const Segment& s : near) {
          if (s.theme != kCoverage) compare(s, border);
        }
      }
    });
  }

  /// Whether the segment lies in the closed coverage. A segment that leaves it through a corner does not, nor does one
  /// that passes through a corner inside.
  bool inside(const Segment& s) const {
    const auto found = contacts_.find(s);
    if (found == contacts_.end()) return true;
    if (found->second & kCrosses) return false;
    return found->second != (kTouchesA | kTouchesB) || middle_inside(s);
  }

  void ends_on_outline(const Segment& s, Codes& out) const {
    const auto found = contacts_.find(s);
    if (found == contacts_.end()) return;
    if (found->second & kTouchesA) out.push_back(code_of(s.a()));
    if (found->second & kTouchesB) out.push_back(code_of(s.b()));
  }

 private:
  static constexpr unsigned kCrosses = 1, kTouchesA = 2, kTouchesB = 4;

  void compare(const Segment& s, const Segment& border) {
    const Position a = s.a(), b = s.b(), p = border.a(), q = border.b();
    unsigned contact = 0;
    if (on_segment(p, q, a)) contact |= kTouchesA;
    if (on_segment(p, q, b)) contact |= kTouchesB;
    const auto within = [&](Position corner) { return corner != a && corner != b && on_segment(a, b, corner); };
    if (crosses(s, p, q) || within(p) || within(q)) contact |= kCrosses;
    if (contact != 0) contacts_[s] |= contact;
  }

  /// Whether the segment's middle is inside, by the winding number of the outline about it, in doubled coordinates.
  bool middle_inside(const Segment& s) const {
    const std::int64_t x = std::int64_t{s.ax} + s.bx, y = std::int64_t{s.ay} + s.by;
    int winding = 0;
    for (const Segment& border : outline_) {
      const std::int64_t ay = 2 * std::int64_t{border.ay}, by = 2 * std::int64_t{border.by};
      if (std::max(ay, by) < y || std::min(ay, by) > y) continue;
      const std::int64_t ax = 2 * std::int64_t{border.ax}, bx = 2 * std::int64_t{border.bx};
      const Int128 side = Int128{bx - ax} * (y - ay) - Int128{by - ay} * (x - ax);
      if (side == 0 && std::min(ax, bx) <= x && x <= std::max(ax, bx)) return true;
      if (ay <= y && by > y && side > 0) ++winding;
      if (ay > y && by <= y && side < 0) --winding;
    }
    return winding > 0;
  }

  const std::vector<Segment>& outline_;
  std::map<Segment, unsigned> contacts_;
};

}  // namespace

std::vector<std::uint32_t> ThemeLines::terrain_vertices() const {
  std::vector<std::uint32_t> vertices;
  for (const PlanarEdge& e : lines.edges)
    if (lies(e) && terrain[e.owner]) vertices.insert(vertices.end(), {e.from, e.to});
  sort_unique(vertices);
  return vertices;
}

Segment raised_segment(const PlanarEdge& edge, const ThemeLines& lines) {
  const GridPoint &a = lines.lines.vertices[edge.from], &b = lines.lines.vertices[edge.to];
  return {a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(edge.owner + 1)};
}

std::vector<Segment> raised_segments(const ThemeLines& lines) {
  std::vector<Segment> segments;
  for (const PlanarEdge& e : lines.lines.edges)
    if (lines.is_raised(e)) segments.push_back(raised_segment(e, lines));
  return segments;
}

std::vector<Segment> ground_segments(const ThemeLines& lines) {
  std::vector<Segment> segments;
  for (const PlanarEdge& e : lines.lines.edges) {
    if (!lines.keeps_ground(e)) continue;
    const GridPoint &a = lines.lines.vertices[e.from], &b = lines.lines.vertices[e.to];
    // Such edges are in level 0 alone, for coarser surfaces have other edges.
    segments.push_back({a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(e.owner + 1), 0, 0});
  }
  for (const PlacedBorder& b : lines.borders) segments.push_back(segment_of(b.border));
  return segments;
}

Segment segment_of(const BorderEdge& border) {
  const auto& [a, b] = border.edge;
  return {a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(border.theme + 1), 0, 0};
}

std::vector<ThemeVertex> crossings_of_ground(const ThemeLines& lines) {
  std::vector<ThemeVertex> ends, known = lines.ground_ends, crossings;
  for (const PlanarEdge& e : lines.lines.edges) {
    if (!lines.keeps_ground(e)) continue;
    for (const std::uint32_t v : {e.from, e.to}) ends.push_back({e.owner, code_of(lines.lines.vertices[v])});
  }
  for (const PlacedPart& part : lines.parts)
    for (const PartVertex& v : part.vertices) known.push_back({part.part.theme - 1u, code_of(v.point)});
  sort_unique(ends);
  std::sort(known.begin(), known.end());
  std::set_difference(ends.begin(), ends.end(), known.begin(), known.end(), std::back_inserter(crossings));
  return crossings;
}

namespace {

/// The ends where a theme's line goes on as another feature's: not all of the theme's segments that meet there belong
/// to the same features.
Codes ends_of_features(const std::vector<Segment>& segments, const std::vector<SegmentFeature>& of_features) {
  using End = std::pair<std::uint64_t, std::uint16_t>;  // code, theme
  std::vector<End> all;
  std::vector<std::pair<End, std::uint32_t>> own;  // ends, each with a feature
  for (const Segment& s : segments)
    for (const std::uint64_t code : {code_of(s.a()), code_of(s.b())}) all.emplace_back(code, s.theme);
  for (const auto& [s, feature] : of_features)
    for (const std::uint64_t code : {code_of(s.a()), code_of(s.b())}) own.push_back({{code, s.theme}, feature});
  std::sort(all.begin(), all.end());
  std::sort(own.begin(), own.end());
  Codes codes;
  for (auto at = own.begin(); at != own.end();) {
    const auto next = std::upper_bound(at, own.end(), *at);
    const auto [first, last] = std::equal_range(all.begin(), all.end(), at->first);
    // Lines that only lie on the ground are not among these ends: they are whole at every level.
    if (first != last && last - first != next - at) codes.push_back(at->first.first);
    at = next;
  }
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

}  // namespace

PlacedLines place_lines(const ThemeLines& lines, const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                        const Sources& ground, const std::vector<std::array<double, 4>>& gap_bases,
                        const std::vector<Segment>& outline, Progress& progress) {
  const std::vector<GridPoint>& vertices = lines.lines.vertices;
  Codes codes, wanted;
  for (const GridPoint& p : vertices) codes.push_back(code_of(p));
  for (const PlanarEdge& e : lines.lines.edges) {
    if (lines.lies(e)) wanted.insert(wanted.end(), {codes[e.from], codes[e.to]});
  }
  sort_unique(wanted);
  const SourceIndex ground_index(index, ground);
  const Codes on_ground =
      joined_runs<std::uint64_t>(tiles.size(), "laying lines on the ground", progress, [&](std::size_t i) {
        const auto own = in_cell(wanted, tiles[i].cell);
        return own.empty() ? Codes() : grounded(own, ground_index, gap_bases);
      });
  const auto lies = [&](std::uint32_t v) { return std::binary_search(on_ground.begin(), on_ground.end(), codes[v]); };

  std::vector<Segment> candidates;
  std::vector<std::uint32_t> edges;  // the candidates' numbers
  for (std::uint32_t i = 0; i < lines.lines.edges.size(); ++i) {
    const PlanarEdge& e = lines.lines.edges[i];
    if (!lines.lies(e) || !lies(e.from) || !lies(e.to)) continue;
    const GridPoint &a = vertices[e.from], &b = vertices[e.to];
    candidates.push_back({a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(e.owner + 1)});
    edges.push_back(i);
  }
  const OutlineTest test(outline, candidates);
  PlacedLines placed;
  auto feature = lines.lines.features.begin();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Segment& s = candidates[i];
    if (!test.inside(s)) continue;
    while (feature != lines.lines.features.end() && feature->edge < edges[i]) ++feature;
    for (; feature != lines.lines.features.end() && feature->edge == edges[i]; ++feature)
      placed.of_features.push_back({s, feature->feature});
    const bool terrain = lines.terrain[s.theme - std::size_t{1}];
    (terrain ? placed.terrain : placed.features).push_back(s);
    for (const std::uint64_t end : {code_of(s.a()), code_of(s.b())}) placed.ends.push_back(end);
    test.ends_on_outline(s, placed.on_outline);
  }
  const auto on_the_ground = std::count_if(lines.lines.edges.begin(), lines.lines.edges.end(),
                                           [&](const PlanarEdge& e) { return lines.lies(e); });
  std::sort(placed.of_features.begin(), placed.of_features.end());
  placed.feature_ends = ends_of_features(placed.terrain, placed.of_features);
  placed.left_out = static_cast<std::uint64_t>(on_the_ground) - placed.terrain.size() - placed.features.size();
  sort_unique(placed.ends);
  for (const std::uint32_t v : lines.terrain_vertices())
    if (!lies(v)) placed.strays.push_back(codes[v]);
  return placed;
}

namespace {

/// The most points of ground that are triangulated at once to drape positions on it, unless these are one.
constexpr std::uint64_t kMostDraped = 1 << 16;

/// Divides ascending codes into runs, about each of which the ground has few points.
void divide(std::span<const std::uint64_t> codes, const PointIndex& ground,
            std::vector<std::span<const std::uint64_t>>& runs) {
  const GridBox box = box_of(codes, position_of);
  if (codes.size() == 1 || points_of_leaves(ground, box) <= kMostDraped) return runs.push_back(codes);
  const Cell cell = cell_about(box);
  for (int i = 0; i < 4; ++i) {
    const auto end = std::lower_bound(codes.begin(), codes.end(), cell.child(i).end());
    const auto own = codes.first(static_cast<std::size_t>(end - codes.begin()));
    if (!own.empty()) divide(own, ground, runs);
    codes = codes.subspan(own.size());
  }
}

std::vector<GridPoint> draped_run(std::span<const std::uint64_t> codes, const PointIndex& ground) {
  const RegionMesh region = triangulate_region(ground, everything(), box_of(codes, position_of));
  std::map<std::uint64_t, GridPoint> draped;
  const auto corners = [&](std::size_t t) { return region.corners(static_cast<std::uint32_t>(t)); };
  for_each_inside(region.mesh.triangles.size(), corners, codes, [&](std::size_t t, Position p) {
    const auto& [a, b, c] = region.mesh.triangles[t];
    const GridPoint &pa = region.vertices[a].point, &pb = region.vertices[b].point, &pc = region.vertices[c].point;
    const std::int64_t wa = doubled_area(p, pb, pc), wb = doubled_area(pa, p, pc), wc = doubled_area(pa, pb, p);
    const std::int64_t z =
        rounded_quotient(Int128{wa} * pa.z + Int128{wb} * pb.z + Int128{wc} * pc.z, Int128{wa} + wb + wc);
    draped.try_emplace(code_of(p), GridPoint{p.x, p.y, static_cast<std::int32_t>(z)});
  });
  for (const SelectedVertex& v : region.vertices) draped.erase(code_of(v.point));
  std::vector<GridPoint> result;
  for (const auto& [code, point] : draped) result.push_back(point);
  return result;
}

}  // namespace

std::vector<GridPoint> drape(const std::vector<std::uint64_t>& codes, const PointIndex& ground, Progress& progress) {
  std::vector<std::span<const std::uint64_t>> runs;
  if (!codes.empty()) divide(codes, ground, runs);
  return joined_runs<GridPoint>(runs.size(), "draping lines", progress,
                                [&](std::size_t i) { return draped_run(runs[i], ground); });
}

}  // namespace itin
