// What a map takes that follows the mouse, over surfaces that are held: the processor time until 1 cell in 81, 1 in 9
// and all are decided when a mast moves by a cell, and how long a call takes to return once it is cancelled.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/import.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/relief.hpp>

#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

const std::string kDemo = ITIN_SOURCE_DIR "/scripts/demo-data/", kData = ITIN_DATA_DIR "/";

/// Where a mast stands, how far it looks, and over which store.
struct MastDrag {
  std::string store;  ///< cardiff, wales, town or lidar
  Point2 mast;
  double radius = 0, cell = 0;
};

// Both of about 126,000 or 1.0 million cells; the fine cells have sizes with an exact binary form.
const MastDrag kCardiff{"cardiff", {319000, 189000}, 10000, 50}, kWales10{"wales", {275000, 260000}, 10000, 17.5},
    kWales40{"wales", {275000, 260000}, 40000, 70}, kSummit40{"wales", {278970, 286940}, 40000, 70},
    kTown{"town", {319010, 189010}, 1000, 5}, kTownFine{"town", {319010, 189010}, 1000, 1.75},
    kLidar{"lidar", {300000, 6801500}, 500, 0.875};

/// Tiles of 10 km, named by the National Grid, of the part of Wales that the masts see.
bool is_seen(const std::string& tile) {
  static const std::map<std::string, Point2> squares{
      {"sh", {200000, 300000}}, {"sj", {300000, 300000}}, {"sn", {200000, 200000}}, {"so", {300000, 200000}}};
  const auto square = squares.find(tile.substr(0, 2));
  if (square == squares.end()) return false;
  const double x = square->second.x + 10000 * (tile[2] - '0'), y = square->second.y + 10000 * (tile[3] - '0');
  return x + 10000 > 228000 && x < 326000 && y + 10000 > 213000 && y < 334000;
}

void import_wales(const std::string& store) {
  ImportOptions options;
  for (const auto& file : std::filesystem::directory_iterator(kData + "os-terrain50-wales/tiles"))
    if (is_seen(file.path().filename())) options.sources.push_back(file.path().string());
  NoProgress progress;
  import_terrain(store, options, progress);
}

void import_lidar(const std::string& store) {
  ImportOptions options;
  for (const std::string tile : {"0299", "0300"})
    options.sources.push_back(kData + "derived-las/ign_" + tile + "_6802.las");
  NoProgress progress;
  import_terrain(store, options, progress);
}

/// 2,468 houses in streets, on the ground about Cardiff.
void write_houses(const std::string& path) {
  std::ofstream file(path);
  file << R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:27700"}},"features":[)";
  for (int i = 0; i < 2468; ++i) {
    const int west = 318000 + i % 50 * 40, south = 188000 + i / 50 * 40;
    file << (i == 0 ? "" : ",") << R"({"type":"Feature","properties":{"HEIGHT":)" << 5 + i % 7
         << R"(},"geometry":{"type":"Polygon","coordinates":[[)";
    const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {12, 3}, {10, 11}, {-2, 8}}};
    for (const auto& [x, y] : corners) file << '[' << west + x << ',' << south + y << "],";
    file << '[' << west << ',' << south << "]]]}}";
  }
  file << "]}";
}

void import_cardiff(const std::string& store) {
  ImportOptions options;
  options.sources = {kDemo + "cardiff.tif"};
  NoProgress progress;
  import_terrain(store, options, progress);
}

void import_town(const std::string& store) {
  import_cardiff(store);
  ImportOptions options;
  options.sources = {store + ".geojson"};
  write_houses(options.sources.front());
  options.kind = ThemeKind::Buildings;
  options.height_field = "HEIGHT";
  NoProgress progress;
  import_lines(store, options, progress);
}

/// A store that is imported when it is first asked for; null where its data is not there.
const Store* store_of(const std::string& name) {
  static const test::TemporaryDirectory directory;
  static std::map<std::string, std::unique_ptr<Store>> stores;
  static const std::map<std::string, void (*)(const std::string&)> imports{
      {"cardiff", import_cardiff}, {"wales", import_wales}, {"town", import_town}, {"lidar", import_lidar}};
  if ((name == "wales" || name == "lidar") && !std::filesystem::exists(kData)) return nullptr;
  std::unique_ptr<Store>& store = stores[name];
  if (!store) {
    const std::string path = directory.file(name + ".itin");
    imports.at(name)(path);
    store = std::make_unique<Store>(path);
  }
  return store.get();
}

Request request_of(const MastDrag& drag, Mode mode) {
  Request request;
  request.observers = {{"mast", drag.mast, 20}};
  request.target_height = 2;
  request.radius = drag.radius;
  request.cell_size = drag.cell;
  request.themes = ThemeChoice::all();
  request.mode = mode;
  request.vertical_error = {0.5, 40};
  request.radio.frequency_ghz = 2.5;
  request.radio.effective_earth_km = effective_earth_km(request.earth);
  request.fresnel.wavelength = wavelength_m(2.5);
  return request;
}

HeldSurface surface_about(const Store& store, const MastDrag& drag) {
  const double reach = drag.radius + 100 * drag.cell;
  const auto [x, y] = drag.mast;
  NoProgress progress;
  return {store,
          {x - reach, y - reach, x + reach, y + reach},
          Detail::tolerance(0),
          ThemeChoice::all(),
          {.memory_bytes = std::uint64_t{4} << 30},
          progress};
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void count(benchmark::State& state, const std::string& name, const std::vector<double>& milliseconds) {
  state.counters[name] = quantile(milliseconds, 0.5);
  state.counters[name + "_95"] = quantile(milliseconds, 0.95);
}

/// The mast moves by one cell each time.
void BM_LiveMap(benchmark::State& state, const MastDrag& drag) {
  const Store* const store = store_of(drag.store);
  if (store == nullptr) return state.SkipWithError("no data");
  const HeldSurface surface = surface_about(*store, drag);
  Request request = request_of(drag, static_cast<Mode>(state.range(0)));
  std::map<std::int64_t, std::vector<double>> times;
  NoProgress progress;
  std::uint64_t cells = 0;
  for (auto _ : state) {
    request.observers.front().position.x += drag.cell;
    std::map<std::int64_t, double> ends;
    const double begin = processor_ms();
    const Result result = surface.compute(request, progress, [&](const Result&, const DecidedCells& decided) {
      ends[decided.step] = processor_ms() - begin;
    });
    ends[1] = processor_ms() - begin;
    for (const auto& [step, end] : ends) times[step].push_back(end);
    cells = result.cells.in_view();
  }
  count(state, "first_ms", times[9]);
  count(state, "ninth_ms", times[3]);
  count(state, "all_ms", times[1]);
  state.counters["cells"] = static_cast<double>(cells);
}
BENCHMARK_CAPTURE(BM_LiveMap, cardiff_10_km, kCardiff)
    ->Arg(0)
    ->Arg(5)
    ->Arg(8)
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, wales_10_km, kWales10)
    ->Arg(0)
    ->Arg(5)
    ->Arg(8)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, wales_40_km, kWales40)
    ->Arg(0)
    ->Arg(5)
    ->Arg(8)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, wales_40_km_summit, kSummit40)
    ->Arg(0)
    ->Arg(5)
    ->Arg(8)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, town, kTown)->Arg(0)->Arg(5)->Arg(8)->Iterations(40)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, town_fine, kTownFine)
    ->Arg(0)
    ->Arg(5)
    ->Arg(8)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_LiveMap, lidar, kLidar)->Arg(0)->Arg(5)->Arg(8)->Iterations(40)->Unit(benchmark::kMillisecond);

/// A tile of the map's shaded ground, 256 pixels wide, so many metres a pixel.
void BM_Relief(benchmark::State& state) {
  const Store* const store = store_of("wales");
  if (store == nullptr) return state.SkipWithError("no data");
  const auto metres = static_cast<double>(state.range(0));
  const RasterGrid pixels({275000 - 128 * metres, 272000 + 128 * metres}, metres, metres, 256, 256);
  NoProgress progress;
  std::vector<double> times;
  for (auto _ : state) {
    const double begin = processor_ms();
    benchmark::DoNotOptimize(relief(*store, pixels, progress));
    times.push_back(processor_ms() - begin);
  }
  count(state, "tile_ms", times);
}
BENCHMARK(BM_Relief)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Iterations(20)->Unit(benchmark::kMillisecond);

/// Is cancelled once the process has taken some more processor time.
class CancelledAfter final : public Progress {
 public:
  explicit CancelledAfter(double milliseconds) : moment_(processor_ms() + milliseconds) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return processor_ms() >= moment_; }
  /// What each thread has taken since then.
  double milliseconds_since() const { return (processor_ms() - moment_) / thread_count(); }

 private:
  double moment_;
};

/// Cancels at moments spread over the time that the call takes.
void BM_Cancel(benchmark::State& state, const MastDrag& drag) {
  const Store* const store = store_of(drag.store);
  if (store == nullptr) return state.SkipWithError("no data");
  const HeldSurface surface = surface_about(*store, drag);
  const Request request = request_of(drag, static_cast<Mode>(state.range(0)));
  const CellSink sink = [](const Result&, const DecidedCells&) {};
  NoProgress never;
  const double begin = processor_ms();
  std::ignore = surface.compute(request, never, sink);
  const double whole = processor_ms() - begin;
  std::vector<double> delays;
  double share = 0;
  for (auto _ : state) {
    share = std::fmod(share + 0.618034, 1);
    CancelledAfter progress(share * whole);
    try {
      std::ignore = surface.compute(request, progress, sink);
    } catch (const Cancelled&) {
      delays.push_back(progress.milliseconds_since());
    }
  }
  if (delays.empty()) return state.SkipWithError("nothing was cancelled");
  count(state, "delay_ms", delays);
  state.counters["whole_ms"] = whole;
}
BENCHMARK_CAPTURE(BM_Cancel, cardiff_10_km, kCardiff)->DenseRange(0, 9)->Iterations(40)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Cancel, wales_40_km, kWales40)
    ->Arg(0)
    ->Arg(5)
    ->Arg(6)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Cancel, town, kTown)->DenseRange(0, 9)->Iterations(40)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Cancel, lidar, kLidar)->Arg(0)->Arg(5)->Arg(6)->Iterations(40)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace itin::viewshed
