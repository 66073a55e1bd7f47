#include "pyramid/replacement.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include <itin/detail.hpp>
#include <itin/parallel.hpp>

#include "pyramid/coverage.hpp"
#include "pyramid/source_index.hpp"

namespace itin {

namespace {

/// For each source, those that take its place. Empty sets are left out.
std::map<std::uint16_t, Sources> replacing(const std::vector<SourceInfo>& sources) {
  std::map<std::uint16_t, Sources> result;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t r = 0; r < sources.size(); ++r) {
      if (!sources[r].replaces || sources[r].spacing >= sources[s].spacing) continue;
      result[static_cast<std::uint16_t>(s)].insert(static_cast<std::uint16_t>(r));
    }
  }
  return result;
}

/// Codes of those points (ordered by x) that lie in a ground triangle of the given sources.
std::vector<std::uint64_t> covered(const WorkingIndex& index, const Sources& sources,
                                   const std::vector<Position>& points,
                                   const std::vector<std::array<double, 4>>& gap_bases) {
  GridBox box;
  for (const Position p : points) box.extend(p.x, p.y);
  const SourceIndex finer(index, sources);
  const RegionMesh region = triangulate_region(finer, Selection(Detail::tolerance(0), {0.0}, Grid{}), box);
  const std::vector<std::uint8_t> ground = ground_triangles(region, gap_bases);
  std::vector<std::uint64_t> result;
  for (std::size_t t = 0; t < ground.size(); ++t) {
    if (!ground[t]) continue;
    const auto& corners = region.mesh.triangles[t];
    const Position a = region.vertices[corners[0]].position(), b = region.vertices[corners[1]].position();
    const Position c = region.vertices[corners[2]].position();
    const std::int32_t last = std::max({a.x, b.x, c.x});
    auto p = std::lower_bound(points.begin(), points.end(), std::min({a.x, b.x, c.x}),
                              [](Position q, std::int32_t x) { return q.x < x; });
    for (; p != points.end() && p->x <= last; ++p) {
      if (orientation(a, b, *p) >= 0 && orientation(b, c, *p) >= 0 && orientation(c, a, *p) >= 0)
        result.push_back(morton(p->x, p->y));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

std::uint64_t drop_replaced(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                            const std::vector<SourceInfo>& sources, const std::vector<std::array<double, 4>>& gap_bases,
                            const std::vector<std::uint64_t>& kept, Progress& progress) {
  const std::map<std::uint16_t, Sources> replaced_by = replacing(sources);
  if (replaced_by.empty()) return 0;
  // All tiles are read before any is written: what is dropped here must not change what covers it there.
  std::vector<std::vector<std::uint64_t>> dropped(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    std::map<Sources, std::vector<Position>> candidates;
    for (const RawPoint& p : index.read(tiles[i])) {
      const auto found = replaced_by.find(p.source);
      if (found == replaced_by.end() || std::binary_search(kept.begin(), kept.end(), p.code)) continue;
      candidates[found->second].push_back({morton_x(p.code), morton_y(p.code)});
    }
    for (auto& [finer, points] : candidates) {
      std::sort(points.begin(), points.end());
      const std::vector<std::uint64_t> codes = covered(index, finer, points, gap_bases);
      dropped[i].insert(dropped[i].end(), codes.begin(), codes.end());
    }
    progress.report("replacing coarser ground", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  std::vector<std::uint64_t> all;
  for (const auto& codes : dropped) all.insert(all.end(), codes.begin(), codes.end());
  return index.drop(std::move(all));
}

}  // namespace itin
