#include "workflows/dwellings/dwelling_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "line/cell_tiles.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"

namespace itin::viewshed {

namespace {

/// The surface with its triangles, its scene and its pyramid of heights, and the bare one, for each point of that.
constexpr std::uint64_t kBytesOfSunlitPoint = kPointsWithFeatures * (kBytesPerSurfacePoint + 300) + 60;

/// The surface without woods, which waits while another is judged, and the foliage about an eye on each thread.
constexpr std::uint64_t kBytesOfSeasons = kPointsWithFeatures * 160;

std::uint64_t bytes_of(const DwellingsRequest& request, std::uint64_t points) {
  return points * (kBytesOfSunlitPoint + (request.foliage ? kBytesOfSeasons : 0));
}

bool holds_pairs(const DwellingsRequest& request, std::uint64_t points) {
  return holds_ground(request.memory_bytes, bytes_of(request, points));
}

/// Adds the tiles of all lines from one box to another: those to the first from each corner of the second, and those
/// from its middle to the second, which lie between them.
void add_lines_between(const GroundTiles& ground, const Box& from, const Box& to, TileSet& tiles) {
  for (const Point2 corner :
       std::array<Point2, 4>{{{to.xmin, to.ymin}, {to.xmax, to.ymin}, {to.xmax, to.ymax}, {to.xmin, to.ymax}}})
    ground.add_lines(corner, from, tiles);
  ground.add_lines(middle_of(from), to, tiles);
}

/// Puts the pairs of one turbine after those of another, each turbine's by azimuth: so neighbours share most of their
/// ground.
void sort_by_azimuth(std::vector<DwellingPair>& pairs) {
  const auto order = [](const DwellingPair& p) {
    const Point2 from = middle_of(p.ends), to = middle_of(p.eyes);
    return std::pair(p.turbine, std::atan2(to.y - from.y, to.x - from.x));
  };
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const DwellingPair& a, const DwellingPair& b) { return order(a) < order(b); });
}

[[noreturn]] void refuse(const DwellingsRequest& request, const DwellingPair& pair, std::uint64_t points) {
  constexpr std::uint64_t kMega = 1 << 20;
  const Point2 at = middle_of(pair.eyes);
  throw InputError(
      fmt::format("the ground between turbine {} and the dwelling at {:.10g},{:.10g} takes about {} MB, more than the "
                  "{} MB of memory: give more `memory_bytes`",
                  request.turbines.turbines[pair.turbine].number, at.x, at.y, bytes_of(request, points) / kMega,
                  request.memory_bytes / kMega),
      "memory_bytes");
}

}  // namespace

std::vector<DwellingSegment> dwelling_segments(const Store& store, const DwellingsRequest& request,
                                               std::vector<DwellingPair> pairs, const Progress& progress) {
  if (pairs.empty()) return {};
  Box all;
  for (const DwellingPair& pair : pairs) all.extend(pair.eyes), all.extend(pair.ends);
  constexpr double kAbout = 1;
  all = {all.xmin - kAbout, all.ymin - kAbout, all.xmax + kAbout, all.ymax + kAbout};
  all = intersection(all, store.metadata().grid.box(store.metadata().bounds));
  const std::uint64_t points = store.points_about(0, all);
  if (holds_pairs(request, points)) return {{std::move(pairs), Window::box(all), points}};
  sort_by_azimuth(pairs);
  const GroundTiles ground(store, 0, all);
  std::vector<std::size_t> numbers(pairs.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  const auto needed = [&](std::size_t i) {
    progress.throw_if_cancelled();
    TileSet tiles(ground.count());
    add_lines_between(ground, pairs[i].eyes, pairs[i].ends, tiles);
    return tiles;
  };
  const auto fits = [&](const TileSet& tiles) { return holds_pairs(request, ground.points(tiles)); };
  std::vector<DwellingSegment> segments;
  for (const GroundRun& run : ground_runs(numbers, ground.count(), needed, fits)) {
    if (!fits(run.ground)) refuse(request, pairs[run.pieces.front()], ground.points(run.ground));
    DwellingSegment segment{{}, ground.window(run.ground), ground.points(run.ground)};
    for (const std::size_t i : run.pieces) segment.pairs.push_back(pairs[i]);
    segments.push_back(std::move(segment));
  }
  return segments;
}

Effort effort_of_dwellings(const DwellingSegment& segment) {
  constexpr double kLinesOfPair = 2000;
  return {effort_of_triangles(kPointsWithFeatures * segment.points),
          effort_of_lines(kLinesOfPair * static_cast<double>(segment.pairs.size()))};
}

}  // namespace itin::viewshed
