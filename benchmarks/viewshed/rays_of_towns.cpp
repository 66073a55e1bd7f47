// Lines from masts to the walls and to the cells of a town: decided exactly by rays, and by Embree alone, whose single
// precision errs where a line grazes. benchmarks/peers/rays.sh makes the towns and prints how both compare.
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/building_outlines.hpp>
#include <itin/earth.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "line/sight_lines.hpp"
#include "places/mount_places.hpp"
#include "scene/rays/embree.hpp"
#include "scene/rays/scene.hpp"

namespace itin::viewshed {
namespace {

constexpr int kMastsASide = 4;
constexpr double kMastHeight = 25;
constexpr double kCell = 2, kTargetHeight = 2;

/// A town's surface, its masts, places a metre apart half-way up its walls, those of a building one after another, and
/// cells of 2 m, four by four, 2 m above the surface; all in grid units.
struct Town {
  std::shared_ptr<const PlacedSurface> surface;
  std::vector<Point3> masts, walls, cells;
};

Point3 in_units(const Tin& tin, const Point3& metres) {
  const Grid& grid = tin.grid;
  return {(metres.x - grid.origin.x) / grid.resolution, (metres.y - grid.origin.y) / grid.resolution,
          metres.z / grid.resolution};
}

Town read_town(const std::string& path) {
  const Store store(path);
  NoProgress progress;
  const auto surface = [&](const ThemeChoice& themes) {
    return std::make_shared<const PlacedSurface>(
        triangulate(store, Window::all(), Detail::tolerance(0), progress, themes), progress);
  };
  Town town{surface(ThemeChoice::all()), {}, {}, {}};
  const auto ground = surface(ThemeChoice::none());
  const Tin& tin = town.surface->tin;
  MountRules rules;
  for (const ThemeInfo& theme : store.metadata().themes) rules.of_buildings.push_back(is_of_buildings(theme));
  const Box box = tin.bounds();
  for (const BuildingFoot& foot : building_feet(store, ThemeChoice::all(), box))
    for (const WallPlace& place : wall_places({foot, *town.surface, *ground, rules}, progress))
      town.walls.push_back(
          in_units(tin, {place.position.x, place.position.y, place.ground_m + (place.least_m + place.most_m) / 2}));
  constexpr double kPacket = kPacketSide * kCell;
  for (double y = box.ymin; y < box.ymax; y += kPacket)
    for (double x = box.xmin; x < box.xmax; x += kPacket)
      for (unsigned i = 0; i < SightLines::kSize; ++i) {
        const unsigned column = i % kPacketSide, row = i / kPacketSide;
        const Point2 at{x + (column + 0.5) * kCell, y + (row + 0.5) * kCell};
        if (const auto z = town.surface->height(at))
          town.cells.push_back(in_units(tin, {at.x, at.y, *z + kTargetHeight}));
      }
  for (int column = 0; column < kMastsASide; ++column) {
    for (int row = 0; row < kMastsASide; ++row) {
      const Point2 at{box.xmin + (0.5 + column) / kMastsASide * (box.xmax - box.xmin),
                      box.ymin + (0.5 + row) / kMastsASide * (box.ymax - box.ymin)};
      if (const auto z = ground->height(at)) town.masts.push_back(in_units(tin, {at.x, at.y, *z + kMastHeight}));
    }
  }
  return town;
}

/// The town of the store that ITIN_TOWN names.
const Town* town(benchmark::State& state) {
  const char* const path = std::getenv("ITIN_TOWN");
  if (path == nullptr) {
    state.SkipWithError("ITIN_TOWN names no store; benchmarks/peers/rays.sh makes some");
    return nullptr;
  }
  static const Town town = read_town(path);
  return &town;
}

/// Targets of the town.
using Targets = std::vector<Point3> Town::*;

/// Calls judge(lines) for packets of lines from each mast to all targets.
template <class Judge>
void judge_all(benchmark::State& state, const Town& of, Targets targets, const Judge& judge) {
  const std::vector<Point3>& all = of.*targets;
  if (all.empty()) return state.SkipWithError("the store has none");
  std::int64_t lines = 0;
  std::int64_t hidden = 0;
  for (auto _ : state) {
    for (const Point3& mast : of.masts) {
      SightLines packet;
      packet.start_at(mast);
      for (std::size_t first = 0; first < all.size(); first += SightLines::kSize) {
        const std::size_t count = std::min<std::size_t>(SightLines::kSize, all.size() - first);
        packet.active = 0;
        for (std::size_t i = 0; i < count; ++i) {
          const Point3& to = all[first + i];
          packet.to_x[i] = to.x, packet.to_y[i] = to.y, packet.to_z[i] = to.z;
          packet.active |= 1U << i;
        }
        hidden += std::popcount(judge(packet));
        lines += static_cast<std::int64_t>(count);
      }
    }
  }
  state.SetItemsProcessed(lines);
  state.counters["hidden"] = static_cast<double>(hidden) / static_cast<double>(std::max<std::int64_t>(1, lines));
}

void BM_LinesByRays(benchmark::State& state, Targets targets) {
  const Town* const of = town(state);
  if (of == nullptr) return;
  const Scene scene(of->surface->tin, Earth{});
  judge_all(state, *of, targets, [&](const SightLines& lines) { return scene.hidden(lines); });
}
BENCHMARK_CAPTURE(BM_LinesByRays, walls, &Town::walls)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LinesByRays, cells, &Town::cells)->Unit(benchmark::kMillisecond);

/// The triangles in single precision, about their middle and on a flat Earth, in Embree's own kind of geometry.
class PlainEmbree {
 public:
  explicit PlainEmbree(const Tin& tin) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    GridBox box;
    for (const GridPoint& v : tin.vertices) box.extend(v.x, v.y);
    centre_ = {(1.0 * box.xmin + box.xmax) / 2, (1.0 * box.ymin + box.ymax) / 2};
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const at = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), tin.vertices.size()));
    for (std::size_t v = 0; v < tin.vertices.size(); ++v) {
      at[3 * v] = static_cast<float>(tin.vertices[v].x - centre_.x);
      at[3 * v + 1] = static_cast<float>(tin.vertices[v].y - centre_.y);
      at[3 * v + 2] = static_cast<float>(tin.vertices[v].z);
    }
    auto* const corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), tin.triangles.size()));
    for (std::size_t t = 0; t < tin.triangles.size(); ++t)
      std::copy(tin.triangles[t].begin(), tin.triangles[t].end(), corners + 3 * t);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  PlainEmbree(const PlainEmbree&) = delete;
  PlainEmbree& operator=(const PlainEmbree&) = delete;
  ~PlainEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  unsigned hidden(const SightLines& lines) const {
    alignas(64) std::array<int, SightLines::kSize> valid;
    RTCRay16 ray{};
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      valid[i] = (lines.active >> i & 1U) != 0 ? -1 : 0;
      ray.org_x[i] = static_cast<float>(lines.from_x[i] - centre_.x);
      ray.org_y[i] = static_cast<float>(lines.from_y[i] - centre_.y);
      ray.org_z[i] = static_cast<float>(lines.from_z[i]);
      ray.dir_x[i] = static_cast<float>(lines.to_x[i] - lines.from_x[i]);
      ray.dir_y[i] = static_cast<float>(lines.to_y[i] - lines.from_y[i]);
      ray.dir_z[i] = static_cast<float>(lines.to_z[i] - lines.from_z[i]);
      ray.tfar[i] = 1;
      ray.mask[i] = ~0U;
    }
    RayContext context;
    cast_packet(scene_, valid, context, ray);
    unsigned hidden = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i)
      if (valid[i] != 0 && ray.tfar[i] < 0) hidden |= 1U << i;
    return hidden;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  Point2 centre_;
};

void BM_LinesByEmbreeAlone(benchmark::State& state, Targets targets) {
  const Town* const of = town(state);
  if (of == nullptr) return;
  const PlainEmbree scene(of->surface->tin);
  judge_all(state, *of, targets, [&](const SightLines& lines) { return scene.hidden(lines); });
}
BENCHMARK_CAPTURE(BM_LinesByEmbreeAlone, walls, &Town::walls)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LinesByEmbreeAlone, cells, &Town::cells)->Unit(benchmark::kMillisecond);

/// Returns the memory of this process that is in use, bytes.
double resident() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  statm >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void BM_SceneOfTown(benchmark::State& state) {
  const Town* const of = town(state);
  if (of == nullptr) return;
  double bytes = -resident();
  {
    const Scene scene(of->surface->tin, Earth{});
    bytes += resident();
  }
  for (auto _ : state) const Scene scene(of->surface->tin, Earth{});
  const auto triangles = static_cast<double>(of->surface->tin.triangles.size());
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(of->surface->tin.triangles.size()));
  state.counters["triangles"] = triangles;
  state.counters["bytes"] = bytes / triangles;
}
BENCHMARK(BM_SceneOfTown)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace itin::viewshed
