#include "workflows/premises/premises_segments.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "line/cell_tiles.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "plan/memory.hpp"

namespace itin::viewshed {

namespace {

/// The surface with its triangles, its scene, and the pyramids of heights for places, zones and obstacles, for each
/// point of the bare one.
constexpr std::uint64_t kBytesOfPlacedPoint = kPointsWithFeatures * (kBytesPerSurfacePoint + 300);

bool holds_links(const PremisesRequest& request, std::uint64_t points) {
  return holds_ground(request.memory_bytes, points * kBytesOfPlacedPoint);
}

/// Puts buildings near each other one after the other: there and back again in strips.
void sort_in_strips(std::vector<ReachedBuilding>& buildings, double width) {
  const auto order = [&](const ReachedBuilding& b) {
    const double row = std::floor(b.box.ymin / width);
    return std::tuple(row, std::fmod(row, 2) == 0 ? b.box.xmin : -b.box.xmin, b.foot);
  };
  std::sort(buildings.begin(), buildings.end(),
            [&](const ReachedBuilding& a, const ReachedBuilding& b) { return order(a) < order(b); });
}

/// The masts of a building, one after the other; or the building alone.
struct PlannedLink {
  const ReachedBuilding* building = nullptr;
  std::optional<std::size_t> mast = {};
};

/// Puts the links of one mast after those of another, each mast's by azimuth: so neighbours share most of their ground.
std::vector<PlannedLink> links_of(const std::vector<ReachedBuilding>& buildings,
                                  const std::vector<SitePosition>& masts) {
  std::vector<PlannedLink> links;
  for (const ReachedBuilding& building : buildings) {
    for (const std::size_t mast : building.masts) links.push_back({&building, mast});
    if (building.masts.empty()) links.push_back({&building});
  }
  const auto order = [&](const PlannedLink& link) {
    if (!link.mast) return std::pair(std::size_t{0}, 0.0);
    const Point2 from = masts[*link.mast].position, to = middle_of(link.building->box);
    return std::pair(*link.mast, std::atan2(to.y - from.y, to.x - from.x));
  };
  std::stable_sort(links.begin(), links.end(),
                   [&](const PlannedLink& a, const PlannedLink& b) { return order(a) < order(b); });
  return links;
}

/// Plans the segments of links over tiles of ground.
class LinkSegments {
 public:
  LinkSegments(const Store& store, const PremisesRequest& request, const std::vector<SitePosition>& masts,
               const Box& all, const Progress& progress)
      : request_(request), masts_(masts), ground_(store, 0, all), progress_(progress) {}

  std::vector<PremisesSegment> of(const std::vector<PlannedLink>& links) const {
    std::vector<std::size_t> numbers(links.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    const auto needed = [&](std::size_t i) { return tiles_of(links[i]); };
    const auto fits = [&](const TileSet& tiles) { return holds_links(request_, ground_.points(tiles)); };
    std::vector<PremisesSegment> segments;
    for (const GroundRun& run : ground_runs(numbers, ground_.count(), needed, fits)) {
      if (!fits(run.ground)) refuse(links[run.pieces.front()], run.ground);
      segments.push_back(segment_of(links, run));
    }
    return segments;
  }

 private:
  /// The ground that one link needs.
  TileSet tiles_of(const PlannedLink& link) const {
    progress_.throw_if_cancelled();
    TileSet tiles(ground_.count());
    add_ground_under(*link.building, tiles);
    if (link.mast) ground_.add_lines(masts_[*link.mast].position, link.building->box, tiles);
    return tiles;
  }

  void add_ground_under(const ReachedBuilding& building, TileSet& tiles) const {
    ground_.add_lines({building.box.xmin, building.box.ymin}, building.box, tiles);
  }

  PremisesSegment segment_of(const std::vector<PlannedLink>& links, const GroundRun& run) const {
    PremisesSegment segment;
    TileSet about(ground_.count());
    std::unordered_map<std::size_t, std::size_t> numbers;  // where each building is in the segment
    for (const std::size_t i : run.pieces) {
      const auto& [building, mast] = links[i];
      const auto [at, is_new] = numbers.try_emplace(building->foot, segment.buildings.size());
      if (is_new) segment.buildings.push_back({building->foot, {}}), add_ground_under(*building, about);
      if (mast) segment.buildings[at->second].masts.push_back(*mast);
    }
    segment.surface = ground_.window(run.ground), segment.ground = ground_.window(about);
    segment.points = ground_.points(run.ground);
    return segment;
  }

  [[noreturn]] void refuse(const PlannedLink& link, const TileSet& ground) const {
    constexpr std::uint64_t kMega = 1 << 20;
    const Point2 corner{link.building->box.xmin, link.building->box.ymin};
    throw InputError(
        fmt::format("the ground {} the building at {:.10g},{:.10g} takes about {} MB, more than the {} MB of memory: "
                    "give more `memory_bytes`, or a smaller `radius`",
                    link.mast ? fmt::format("between mast {} and", masts_[*link.mast].name) : "about", corner.x,
                    corner.y, ground_.points(ground) * kBytesOfPlacedPoint / kMega, request_.memory_bytes / kMega),
        "memory_bytes");
  }

  const PremisesRequest& request_;
  const std::vector<SitePosition>& masts_;
  const GroundTiles ground_;
  const Progress& progress_;
};

}  // namespace

std::vector<PremisesSegment> premises_segments(const Store& store, const PremisesRequest& request,
                                               const std::vector<SitePosition>& masts,
                                               std::vector<ReachedBuilding> buildings, const Progress& progress) {
  sort_in_strips(buildings, request.radius);
  Box all, about_buildings;
  for (const ReachedBuilding& b : buildings) {
    about_buildings.extend(b.box);
    for (const std::size_t mast : b.masts) all.extend(masts[mast].position);
  }
  all.extend(about_buildings);
  const std::uint64_t points = store.points_about(0, all);
  if (!holds_links(request, points))
    return LinkSegments(store, request, masts, all, progress).of(links_of(buildings, masts));
  PremisesSegment segment{{}, Window::box(all), Window::box(about_buildings), points};
  for (ReachedBuilding& b : buildings) segment.buildings.push_back({b.foot, std::move(b.masts)});
  return {segment};
}

Effort effort_of_premises(const PremisesSegment& segment) {
  constexpr double kLinesOfLink = 400;
  std::size_t links = 0;
  for (const BuildingLinks& building : segment.buildings) links += building.masts.size();
  return {effort_of_triangles(kPointsWithFeatures * segment.points),
          effort_of_lines(kLinesOfLink * static_cast<double>(links))};
}

}  // namespace itin::viewshed
