// One viewshed after another from an observer who walks. The surface is read from the open store each time, or held, or
// read in areas as they are reached. The walks are around Cardiff (a raster of 50 m), seeing 8 km far, and in a town
// with its buildings, seeing 200 m far.
#include <cmath>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <benchmark/benchmark.h>

#include <itin/import.hpp>
#include <viewshed/held_surface.hpp>

namespace itin::viewshed {
namespace {

struct Walk {
  std::string path;
  Box area;
  double radius = 0;

  /// A request from a place on a circle about the middle of the area.
  Request step(double n) const {
    const double round = std::min(area.width(), area.height()) / 2 - radius - 10;
    Request request;
    request.observers = {
        {"walker",
         {(area.xmin + area.xmax) / 2 + round * std::cos(n), (area.ymin + area.ymax) / 2 + round * std::sin(n)},
         2}};
    request.radius = radius;
    request.themes = ThemeChoice::all();
    request.cell_size = radius / 200;
    return request;
  }
};

std::string data(const std::string& name) {
  return std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/" + name;
}

/// Imports the walk's ground, once per process.
Walk make_walk(bool town) {
  const std::string name = "itin-walk-" + std::to_string(getpid()) + (town ? "-town.itin" : ".itin");
  Walk walk{(std::filesystem::temp_directory_path() / name).string(), {}, town ? 200.0 : 8000.0};
  NoProgress progress;
  ImportOptions terrain;
  terrain.sources = {data(town ? "alexandria-dtm.tif" : "cardiff.tif")};
  import_terrain(walk.path, terrain, progress);
  if (town) {
    ImportOptions buildings;
    buildings.sources = {data("alexandria-buildings.geojson")};
    buildings.kind = ThemeKind::Buildings;
    buildings.height_field = "HEIGHT";
    import_lines(walk.path, buildings, progress);
  }
  const StoreMetadata metadata = Store(walk.path).metadata();
  walk.area = metadata.grid.box(metadata.bounds);
  return walk;
}

template <class View>
void walk_on(benchmark::State& state, const Walk& walk, const View& view, double stride = 0.1) {
  double n = 0;
  std::uint64_t visible = 0;
  for (auto _ : state) visible += view(walk.step(n += stride)).cells.visible;
  if (visible == 0) state.SkipWithError("nothing was seen");
}

void BM_WalkReading(benchmark::State& state) {
  const Walk walk = make_walk(state.range(0) != 0);
  const Store store(walk.path);
  NoProgress progress;
  walk_on(state, walk, [&](const Request& request) { return compute(store, request, progress); });
  std::filesystem::remove(walk.path);
}
BENCHMARK(BM_WalkReading)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_WalkHeld(benchmark::State& state) {
  const Walk walk = make_walk(state.range(0) != 0);
  const Store store(walk.path);
  NoProgress progress;
  const HeldSurface surface(store, walk.area, Detail::tolerance(0), ThemeChoice::all(), {}, progress);
  walk_on(state, walk, [&](const Request& request) { return surface.compute(request, progress); });
  std::filesystem::remove(walk.path);
}
BENCHMARK(BM_WalkHeld)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Walks in strides of a fortieth of the radius. The surface is read each time, or by areas in the memory that holds
/// the whole walk.
void BM_Strides(benchmark::State& state, bool paged) {
  const Walk walk = make_walk(state.range(0) != 0);
  const Store store(walk.path);
  NoProgress progress;
  const HeldSurface whole(store, walk.area, Detail::tolerance(0), ThemeChoice::all(), {}, progress);
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::all(), {.memory_bytes = whole.bytes()});
  const double stride = walk.radius / 40 / (std::min(walk.area.width(), walk.area.height()) / 2 - walk.radius);
  const auto view = [&](const Request& request) {
    return paged ? pages.compute(request, progress) : compute(store, request, progress);
  };
  walk_on(state, walk, view, stride);
  state.counters["readings"] = static_cast<double>(pages.readings());
  std::filesystem::remove(walk.path);
}
BENCHMARK_CAPTURE(BM_Strides, reading, false)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Strides, paged, true)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace itin::viewshed
