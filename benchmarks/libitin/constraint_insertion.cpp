// Contours as constraints: inserting them into a triangulation that has their vertices, and a window from the closed
// store. OS Terrain 50's contours of SK00 where the data is at hand, otherwise wavy rings about a hill.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "store/codec/point_index.hpp"
#include "support/vector_file.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace {

using namespace itin;

void write_rings(const std::string& path) {
  std::vector<test::LineFeature> rings;
  for (int k = 1; k <= 60; ++k) {
    const double radius = 80.0 * k;
    const int count = static_cast<int>(radius / 2);
    test::LineFeature ring;
    for (int i = 0; i <= count; ++i) {
      const double angle = 2 * std::numbers::pi * (i % count) / count;
      const double r = radius + 25 * std::sin(9 * angle + 0.7 * k);
      ring.vertices.push_back({400000 + r * std::cos(angle), 300000 + r * std::sin(angle), 1000.0 - 10 * k});
    }
    rings.push_back(std::move(ring));
  }
  test::write_lines(path, rings);
}

/// A store of contours alone, imported without repair, so that every vertex is a contour's.
const std::string& contour_store() {
  static const std::string store = [] {
    const std::string path = (std::filesystem::temp_directory_path() / "itin-benchmark-contours.itin").string();
    std::filesystem::remove(path);
    const std::string gml = std::string(ITIN_DATA_DIR) + "/os-terrain50-contours-sk00/SK00.gml";
    ImportOptions options;
    options.kind = ThemeKind::Contours;
    options.repair = false;
    options.sources = {gml};
    if (std::filesystem::exists(gml)) {
      options.layer = "ContourLine";
      options.z_field = "propertyValue";
    } else {
      options.sources = {path + ".geojson"};
      write_rings(options.sources.front());
    }
    NoProgress progress;
    import_lines(path, options, progress);
    return path;
  }();
  return store;
}

struct Lines {
  std::vector<Position> positions;  ///< along the curve
  std::vector<Delaunay::Constraint> constraints;
};

Lines lines_at(const Store& store, double tolerance) {
  const Selection selection = selection_of(store.metadata(), Detail::tolerance(tolerance), ThemeChoice::none());
  std::vector<Leaf> leaves;
  selected_leaves(store.points(), selection, store.points().bounds(), leaves);
  std::map<std::uint64_t, std::uint32_t> number;
  for (const Leaf& leaf : leaves) {
    for (const GridPoint& p : store.points().block(leaf)->points) {
      if (selection.selects(leaf.level, p.x, p.y)) number.emplace(morton(p.x, p.y), 0);
    }
  }
  Lines lines;
  for (auto& [code, n] : number) {
    n = static_cast<std::uint32_t>(lines.positions.size());
    lines.positions.push_back({morton_x(code), morton_y(code)});
  }
  std::vector<Segment> segments;
  store.points().segments(store.points().bounds(), segments);
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  for (const Segment& s : segments) {
    if (selection.selects(s))
      lines.constraints.emplace_back(number.at(morton(s.ax, s.ay)), number.at(morton(s.bx, s.by)));
  }
  return lines;
}

/// Times insertion into the Delaunay triangulation of all vertices, which is not timed itself.
void constraint_insertion(benchmark::State& state) {
  const Lines lines = lines_at(Store(contour_store()), static_cast<double>(state.range(0)));
  for (auto _ : state) {
    Delaunay delaunay;
    delaunay.insert(lines.positions);
    const auto start = std::chrono::steady_clock::now();
    delaunay.constrain(lines.constraints);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(lines.constraints.size()));
  state.counters["segments"] = static_cast<double>(lines.constraints.size());
}
BENCHMARK(constraint_insertion)->ArgName("tolerance")->Arg(0)->Arg(8)->UseManualTime()->Unit(benchmark::kMillisecond);

/// Times reading, triangulating, constraining and proving points and segments, by one thread.
void window_with_contours(benchmark::State& state) {
  const std::string& path = contour_store();
  const std::size_t segments = lines_at(Store(path), static_cast<double>(state.range(0))).constraints.size();
  set_thread_count(1);
  NoProgress progress;
  for (auto _ : state) {
    const Store store(path);
    benchmark::DoNotOptimize(
        triangulate(store, Window::all(), Detail::tolerance(static_cast<double>(state.range(0))), progress));
  }
  set_thread_count(0);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(segments));
}
BENCHMARK(window_with_contours)->ArgName("tolerance")->Arg(0)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
