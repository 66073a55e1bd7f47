#include "workflows/premises/premises_segments.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <itin/sort_unique.hpp>

#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"

namespace itin::viewshed {

namespace {

/// The surface with its triangles, its scene, and the pyramids of heights for places, zones and obstacles, for each
/// point of the bare one.
constexpr std::uint64_t kBytesOfPlacedPoint = kPointsWithFeatures * (kBytesPerSurfacePoint + 300);

/// Puts buildings near each other one after the other: there and back again in strips.
void sort_in_strips(std::vector<ReachedBuilding>& buildings, double width) {
  const auto order = [&](const ReachedBuilding& b) {
    const double row = std::floor(b.box.ymin / width);
    return std::tuple(row, std::fmod(row, 2) == 0 ? b.box.xmin : -b.box.xmin, b.foot);
  };
  std::sort(buildings.begin(), buildings.end(),
            [&](const ReachedBuilding& a, const ReachedBuilding& b) { return order(a) < order(b); });
}

PremisesSegment segment_of(const std::vector<ReachedBuilding>& buildings, const std::vector<std::size_t>& some) {
  PremisesSegment segment;
  for (const std::size_t i : some) {
    segment.buildings.push_back(buildings[i].foot);
    segment.masts.insert(segment.masts.end(), buildings[i].masts.begin(), buildings[i].masts.end());
  }
  sort_unique(segment.masts);
  return segment;
}

void add_ground_under(const ReachedBuilding& building, const GroundTiles& ground, TileSet& tiles) {
  ground.add_lines({building.box.xmin, building.box.ymin}, building.box, tiles);
}

/// The ground that one building needs.
TileSet tiles_of(const GroundTiles& ground, const ReachedBuilding& building, const std::vector<SitePosition>& masts) {
  TileSet tiles(ground.count());
  add_ground_under(building, ground, tiles);
  for (const std::size_t mast : building.masts) ground.add_lines(masts[mast].position, building.box, tiles);
  return tiles;
}

}  // namespace

std::vector<PremisesSegment> premises_segments(const Store& store, const PremisesRequest& request,
                                               const std::vector<SitePosition>& masts,
                                               std::vector<ReachedBuilding> buildings) {
  sort_in_strips(buildings, request.radius);
  Box all, about_buildings;
  for (const ReachedBuilding& b : buildings) {
    about_buildings.extend(b.box);
    for (const std::size_t mast : b.masts) all.extend(masts[mast].position);
  }
  all.extend(about_buildings);
  std::vector<std::size_t> numbers(buildings.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  const auto fits = [&](std::uint64_t points) { return points * kBytesOfPlacedPoint <= request.memory_bytes; };
  if (const std::uint64_t points = store.points_about(0, all); fits(points)) {
    PremisesSegment segment = segment_of(buildings, numbers);
    segment.surface = Window::box(all), segment.ground = Window::box(about_buildings), segment.points = points;
    return {segment};
  }
  const GroundTiles ground(store, 0, all);
  const auto needed = [&](std::size_t i) { return tiles_of(ground, buildings[i], masts); };
  // The ground of one building has to be held, whatever it takes: then others may share as much and a little more.
  std::uint64_t greatest = 0;
  for (const std::size_t i : numbers) greatest = std::max(greatest, ground.points(needed(i)));
  const auto segment_fits = [&](const TileSet& tiles) {
    const std::uint64_t points = ground.points(tiles);
    return fits(points) || points <= greatest + greatest / 4;
  };
  std::vector<PremisesSegment> segments;
  for (const GroundRun& run : ground_runs(numbers, ground.count(), needed, segment_fits)) {
    PremisesSegment& segment = segments.emplace_back(segment_of(buildings, run.pieces));
    TileSet about(ground.count());
    for (const std::size_t i : run.pieces) add_ground_under(buildings[i], ground, about);
    segment.surface = ground.window(run.ground), segment.ground = ground.window(about);
    segment.points = ground.points(run.ground);
  }
  return segments;
}

Effort effort_of(const PremisesSegment& segment) {
  constexpr double kLinesOfBuilding = 400;
  return {effort_of_triangles(kPointsWithFeatures * segment.points),
          effort_of_lines(kLinesOfBuilding * static_cast<double>(segment.buildings.size() * segment.masts.size()))};
}

}  // namespace itin::viewshed
