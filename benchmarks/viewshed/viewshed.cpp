// The parts of a viewshed and the whole: scene, sight lines, writing; on fractal terrain of half a million triangles.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>
#include <unistd.h>

#include <benchmark/benchmark.h>

#include <itin/progress.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/binned_heights.hpp"
#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "request/eye.hpp"
#include "scene/exact_scene.hpp"
#include "scene/rays/scene.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

constexpr std::int32_t kSide = 513;  // 524,288 triangles
constexpr double kSpacing = 80;      // 41 km across

const Tin& terrain() {
  static const Tin tin = test::fractal_tin(kSide, kSpacing, 900, 0.5, 1);
  return tin;
}

/// The terrain with vertices off the lattice, to measure what lattices are spared.
const Tin& irregular() {
  static const Tin tin = [] {
    Tin moved = terrain();
    std::mt19937 random(1);
    const auto most = static_cast<std::int32_t>(0.2 * kSpacing / moved.grid.resolution);
    std::uniform_int_distribution<std::int32_t> step(-most, most);
    for (GridPoint& v : moved.vertices) v.x += step(random), v.y += step(random);
    return moved;
  }();
  return tin;
}

Request whole(std::int64_t cells) {
  Request request;
  const double extent = (kSide - 1) * kSpacing;
  const Box box = terrain().bounds();
  request.observers = {{"middle", {box.xmin + 0.49 * extent, box.ymin + 0.51 * extent}, 30}};
  request.target_height = 2;
  request.grid = RasterGrid({box.xmin, box.ymax}, extent / static_cast<double>(cells),
                            extent / static_cast<double>(cells), cells, cells);
  return request;
}

void BM_Scene(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Scene(terrain(), Earth{}));
}
BENCHMARK(BM_Scene)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Bins(benchmark::State& state, const Tin& (*surface)()) {
  for (auto _ : state) benchmark::DoNotOptimize(BinnedHeights(surface()).greatest_magnitude());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(surface().triangles.size()));
}
BENCHMARK_CAPTURE(BM_Bins, of_a_lattice, &terrain)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(BM_Bins, off_a_lattice, &irregular)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Boundary(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(boundary_edges(irregular()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(irregular().triangles.size()));
}
BENCHMARK(BM_Boundary)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Does what an exact viewshed does once the surface is in memory: cells as large as those of the terrain, and finer
/// ones.
void decide_cells(benchmark::State& state, const Tin& tin, bool rays) {
  const Request request = whole(state.range(0));
  const RasterGrid tiles = grid_of_tiles(*request.grid);
  ExactScene surface(tin, nullptr, request.earth, *request.grid, tiles);
  if (rays) surface.cast_rays(request.earth);
  const Observer& observer = request.observers.front();
  const Eye eye = eye_of(tin.grid, request, observer, height_on(tin, observer.position));
  std::uint64_t lines = 0;
  for (auto _ : state) {
    const RadialSweep::View view = surface.view_from(eye);
    for (std::size_t tile = 0; tile < tiles.cell_count(); ++tile) {
      TileValues<Verdict> values;
      values.fill(Verdict::kUndecided);
      lines += surface.judge(eye, view, values, *surface.begin(tile));
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(lines));
}

void BM_Sweep(benchmark::State& state) {
  decide_cells(state, terrain(), false);
}
BENCHMARK(BM_Sweep)->Arg(512)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Rays(benchmark::State& state) {
  decide_cells(state, irregular(), true);
}
BENCHMARK(BM_Rays)->Arg(512)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Heights(benchmark::State& state) {
  const Request request = whole(4096);
  const RasterGrid tiles = grid_of_tiles(*request.grid);
  TileValues<double> heights;
  for (auto _ : state) {
    const TriangleBins bins(terrain(), tiles);
    for (std::size_t i = 0; i < tiles.cell_count(); ++i) {
      const Tile tile = tile_at(*request.grid, tiles, i);
      scan_convert(terrain(), bins.triangles(i), tile, TileCentres(terrain().grid, *request.grid, tile), heights);
      benchmark::DoNotOptimize(heights);
    }
  }
  state.SetItemsProcessed(state.iterations() * 4096 * 4096);
}
BENCHMARK(BM_Heights)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Viewshed(benchmark::State& state) {
  const Request request = whole(state.range(0));
  NoProgress progress;
  Result result;
  for (auto _ : state) result = compute(terrain(), request, progress);
  state.counters["lines_per_second"] =
      benchmark::Counter(static_cast<double>(result.statistics.lines), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["scene_s"] = result.statistics.scene_seconds;
  state.counters["lines_s"] = result.statistics.lines_seconds;
  state.counters["visible_share"] =
      static_cast<double>(result.cells.visible) / static_cast<double>(result.grid.cell_count());
}
BENCHMARK(BM_Viewshed)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Simulates surfaces whose errors are independent, or correlated over the given number of metres.
void BM_Probability(benchmark::State& state) {
  Request request = whole(128);
  request.mode = Mode::kProbability;
  request.vertical_error = {2, static_cast<double>(state.range(0))};
  NoProgress progress;
  Result result;
  for (auto _ : state) result = compute(terrain(), request, progress);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(result.statistics.lines));
}
BENCHMARK(BM_Probability)->Arg(0)->Arg(1000)->Unit(benchmark::kMillisecond)->UseRealTime();

std::string output() {
  return (std::filesystem::temp_directory_path() / ("itin-benchmark-" + std::to_string(getpid()) + ".tif")).string();
}

void BM_WriteGeotiff(benchmark::State& state) {
  NoProgress progress;
  const Result result = compute(terrain(), whole(4096), progress);
  GeotiffOptions options;
  options.overwrite = true;
  for (auto _ : state) write_geotiff(output(), result, options);
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(output()));
  std::filesystem::remove(output());
}
BENCHMARK(BM_WriteGeotiff)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_ViewshedToGeotiff(benchmark::State& state) {
  const Request request = whole(4096);
  NoProgress progress;
  GeotiffOptions options;
  options.overwrite = true;
  for (auto _ : state) write_geotiff(output(), compute(terrain(), request, progress), options);
  std::filesystem::remove(output());
}
BENCHMARK(BM_ViewshedToGeotiff)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace itin::viewshed
