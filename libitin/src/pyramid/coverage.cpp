#include "pyramid/coverage.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include <itin/detail.hpp>
#include <itin/parallel.hpp>

#include "triangulate/region.hpp"

namespace itin {

namespace {

/// Decides whether an edge may be ground, by the gap bases of its ends' sources.
class GapRule {
 public:
  explicit GapRule(const std::vector<std::array<double, 4>>& bases) : bases_(bases) {}

  bool bridges(const SelectedVertex& p, const SelectedVertex& q) const {
    const double x = static_cast<double>(q.point.x) - p.point.x, y = static_cast<double>(q.point.y) - p.point.y;
    return within(bases_[p.source], x, y) || (p.source != q.source && within(bases_[q.source], x, y));
  }

 private:
  /// e = a u + b v with |a| <= 1 and |b| <= 1, by Cramer's rule without the division.
  static bool within(const std::array<double, 4>& basis, double x, double y) {
    const auto& [ux, uy, vx, vy] = basis;
    const double determinant = std::abs(ux * vy - uy * vx);
    return std::abs(x * vy - y * vx) <= determinant && std::abs(ux * y - uy * x) <= determinant;
  }

  const std::vector<std::array<double, 4>>& bases_;
};

GridBox box_of(const std::vector<RawPoint>& points) {
  GridBox box;
  for (const RawPoint& p : points) box.extend(morton_x(p.code), morton_y(p.code));
  return box;
}

/// The coverage as seen from one tile's own points: outline edges belong to the tile of their end first on the curve.
Coverage tile_coverage(const WorkingIndex& index, const CurveRange& tile, const GapRule& gaps) {
  static const Selection everything(Detail::tolerance(0), {0.0}, Grid{});
  const RegionMesh region = triangulate_region(index, everything, box_of(index.read(tile)));
  const PlaneMesh& mesh = region.mesh;
  const auto code = [&](std::uint32_t v) { return morton(region.vertices[v].point.x, region.vertices[v].point.y); };

  std::vector<std::uint8_t> ground(mesh.triangles.size());
  std::vector<std::uint8_t> touched(region.vertices.size(), 0);
  for (std::size_t t = 0; t < ground.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    ground[t] = gaps.bridges(region.vertices[a], region.vertices[b]) && gaps.bridges(region.vertices[b], region.vertices[c]) &&
                gaps.bridges(region.vertices[c], region.vertices[a]);
    if (ground[t]) touched[a] = touched[b] = touched[c] = 1;
  }

  Coverage result;
  for (std::size_t t = 0; t < ground.size(); ++t) {
    if (!ground[t]) continue;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t n = mesh.neighbours[t][i];
      if (n != kNoTriangle && ground[n]) continue;
      const std::uint32_t from = mesh.triangles[t][(i + 1) % 3], to = mesh.triangles[t][(i + 2) % 3];
      if (!tile.cell.contains(std::min(code(from), code(to)))) continue;
      const GridPoint &a = region.vertices[from].point, &b = region.vertices[to].point;
      result.outline.push_back({a.x, a.y, b.x, b.y});
    }
  }
  // Points that no triangle meets at all (fewer than three, or all in line) are isolated, too.
  std::vector<std::uint64_t> grounded;
  for (std::uint32_t v = 0; v < region.vertices.size(); ++v) {
    if (touched[v]) grounded.push_back(code(v));
  }
  for (const RawPoint& p : index.read(tile)) {
    if (!std::binary_search(grounded.begin(), grounded.end(), p.code)) result.isolated.push_back(p.code);
  }
  return result;
}

}  // namespace

std::vector<Segment> join_collinear(std::vector<Segment> edges) {
  std::sort(edges.begin(), edges.end());
  using End = std::pair<std::int32_t, std::int32_t>;
  std::map<End, int> arriving;
  for (const Segment& s : edges) arriving[{s.bx, s.by}] += 1;
  const auto leaving = [&](End p) {
    const auto first = std::lower_bound(edges.begin(), edges.end(), p, [](const Segment& s, End e) { return End{s.ax, s.ay} < e; });
    auto last = first;
    while (last != edges.end() && End{last->ax, last->ay} == p) ++last;
    return std::pair{first, last};
  };
  /// The only edge onwards through p, if it goes straight on from s.
  const auto onwards = [&](const Segment& s) -> const Segment* {
    const End p{s.bx, s.by};
    const auto [first, last] = leaving(p);
    if (last - first != 1 || arriving[p] != 1) return nullptr;
    const Position a{s.ax, s.ay}, b{s.bx, s.by}, c{first->bx, first->by};
    const bool forward = (std::int64_t{b.x} - a.x) * (std::int64_t{c.x} - b.x) + (std::int64_t{b.y} - a.y) * (std::int64_t{c.y} - b.y) > 0;
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
    for (const Segment* next = onwards(edges[i]); next != nullptr; next = onwards(*next)) joined.bx = next->bx, joined.by = next->by;
    result.push_back(joined);
  }
  return result;
}

Coverage find_coverage(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                       const std::vector<std::array<double, 4>>& gap_bases, Progress& progress) {
  const GapRule gaps(gap_bases);
  std::vector<Coverage> parts(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    parts[i] = tile_coverage(index, tiles[i], gaps);
    progress.report("finding the coverage", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  Coverage result;
  for (const Coverage& part : parts) {
    result.outline.insert(result.outline.end(), part.outline.begin(), part.outline.end());
    result.isolated.insert(result.isolated.end(), part.isolated.begin(), part.isolated.end());
  }
  result.outline = join_collinear(std::move(result.outline));
  return result;
}

}  // namespace itin
