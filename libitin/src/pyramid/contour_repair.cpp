#include "pyramid/contour_repair.hpp"

#include <algorithm>
#include <atomic>

#include <itin/detail.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "features/contours/flat_skeleton.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

namespace {

using Codes = std::vector<std::uint64_t>;

Codes ends_of(const std::vector<Segment>& segments) {
  Codes codes;
  for (const Segment& s : segments) {
    codes.push_back(code_of(s.a()));
    codes.push_back(code_of(s.b()));
  }
  sort_unique(codes);
  return codes;
}

/// The level edges of the triangles whose first vertex along the curve lies in the tile.
class ContourTile {
 public:
  ContourTile(const RegionMesh& region, const Codes& contours, const Codes& water) : region_(region) {
    for (const SelectedVertex& v : region.vertices) {
      on_contour_.push_back(std::binary_search(contours.begin(), contours.end(), code_of(v.point)));
      on_water_.push_back(std::binary_search(water.begin(), water.end(), code_of(v.point)));
    }
  }

  void collect(const Cell& tile, std::vector<LevelEdge>& out) const {
    for (std::size_t t = 0; t < region_.mesh.triangles.size(); ++t) {
      const Triangle& corners = region_.mesh.triangles[t];
      // Vertices are in Morton order.
      const std::uint32_t first = std::min({corners[0], corners[1], corners[2]});
      if (!tile.contains(code_of(point(first)))) continue;
      const bool flat = is_flat(corners);
      for (int i = 0; i < 3; ++i) add(t, i, flat, out);
    }
  }

 private:
  const GridPoint& point(std::uint32_t v) const { return region_.vertices[v].point; }

  bool is_flat(const Triangle& t) const {
    const auto all = [&](const std::vector<bool>& on) { return on[t[0]] && on[t[1]] && on[t[2]]; };
    return all(on_contour_) && !all(on_water_) && point(t[0]).z == point(t[1]).z && point(t[0]).z == point(t[2]).z;
  }

  void add(std::size_t t, int i, bool flat, std::vector<LevelEdge>& out) const {
    const Triangle& corners = region_.mesh.triangles[t];
    const auto [a, b] = std::minmax({corners[(i + 1) % 3], corners[(i + 2) % 3]});
    if (!on_contour_[a] || !on_contour_[b] || point(a).z != point(b).z) return;
    const bool constrained = (region_.mesh.constrained[t] >> i & 1) != 0;
    out.push_back({point(a), point(b), point(corners[i]), constrained, flat, on_contour_[corners[i]]});
  }

  const RegionMesh& region_;
  std::vector<bool> on_contour_, on_water_;
};

std::vector<LevelEdge> level_edges(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                   const std::vector<Segment>& contours, const std::vector<Segment>& water,
                                   Progress& progress) {
  const Codes on_contour = ends_of(contours), on_water = ends_of(water);
  const Selection everything(Detail::tolerance(0), {0.0}, Grid{});
  std::vector<std::vector<LevelEdge>> of_tile(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    const RegionMesh region = triangulate_region(index, everything, tiles[i].cell.box());
    ContourTile(region, on_contour, on_water).collect(tiles[i].cell, of_tile[i]);
    progress.report("repairing contours", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  std::vector<LevelEdge> edges;
  for (std::vector<LevelEdge>& part : of_tile) {
    edges.insert(edges.end(), part.begin(), part.end());
    part = {};
  }
  return edges;
}

}  // namespace

FlatSurvey::FlatSurvey(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                       const std::vector<Segment>& contours, const std::vector<Segment>& water, Progress& progress)
    : flat_(level_edges(index, tiles, contours, water, progress)) {}

std::vector<GridPoint> FlatSurvey::inferred() const {
  std::vector<std::vector<GridPoint>> of_region(flat_.regions().size());
  parallel_for(of_region.size(), [&](std::size_t i) { of_region[i] = infer_points(flat_, flat_.regions()[i]); });
  std::vector<GridPoint> points;
  for (const std::vector<GridPoint>& part : of_region) points.insert(points.end(), part.begin(), part.end());
  const auto key = [](const GridPoint& p) { return std::pair(code_of(p), p.z); };
  std::sort(points.begin(), points.end(), [&](const GridPoint& p, const GridPoint& q) { return key(p) < key(q); });
  const auto same = [](const GridPoint& p, const GridPoint& q) { return code_of(p) == code_of(q); };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  return points;
}

}  // namespace itin
