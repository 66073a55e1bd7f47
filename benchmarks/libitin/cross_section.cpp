// Cross-sections of 10 km over 50 m terrain, at full detail, one by one and over a surface of tiles.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>

#include "store/codec/point_index.hpp"

namespace itin {
namespace {

using Line = std::pair<Point2, Point2>;

/// The store named by ITIN_BENCHMARK_STORE: a national one of 50 m, say.
std::string store_path() {
  const char* path = std::getenv("ITIN_BENCHMARK_STORE");
  return path != nullptr ? path : "";
}

std::vector<Line> lines_over(const Store& store, double length) {
  const Box box = store.metadata().grid.box(store.metadata().bounds);
  std::mt19937 random(1);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Line> lines;
  while (lines.size() < 256) {
    const Point2 a{box.xmin + share() * box.width(), box.ymin + share() * box.height()};
    const double azimuth = 2 * std::numbers::pi * share();
    const Point2 b{a.x + length * std::sin(azimuth), a.y + length * std::cos(azimuth)};
    if (box.contains(b)) lines.emplace_back(a, b);
  }
  return lines;
}

void report(benchmark::State& state, const CrossSection& sum) {
  const auto lines = static_cast<double>(state.iterations());
  state.counters["triangles"] = static_cast<double>(sum.triangles) / lines;
  state.counters["points_read"] = static_cast<double>(sum.statistics.points_read) / lines;
  state.counters["blocks_read"] = static_cast<double>(sum.statistics.blocks_read) / lines;
  // A strip of triangles has two vertices more.
  state.counters["points_per_vertex"] =
      static_cast<double>(sum.statistics.points_read) / (static_cast<double>(sum.triangles) + 2 * lines);
}

/// The number of non-empty leaves that the lines themselves meet, per line: no retrieval can do without them, except
/// for a few.
double leaves_on(const Store& store, const std::vector<Line>& lines) {
  constexpr double kStep = 5;
  const Grid& grid = store.metadata().grid;
  std::size_t met = 0;
  for (const auto& [a, b] : lines) {
    std::set<std::uint64_t> keys;
    std::vector<Leaf> leaves;
    const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / kStep);
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const GridPoint p = grid.quantise({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0});
      leaves.clear();
      store.points().leaves({}, {p.x, p.y, p.x, p.y}, leaves);
      for (const Leaf& leaf : leaves) keys.insert(leaf.key);
    }
    met += keys.size();
  }
  return static_cast<double>(met) / static_cast<double>(lines.size());
}

template <typename Section>
void run(benchmark::State& state, const std::vector<Line>& lines, const Section& section) {
  for (const auto& [a, b] : lines) section(a, b);  // warm
  CrossSection sum;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [a, b] = lines[i++ % lines.size()];
    const CrossSection found = section(a, b);
    sum.triangles += found.triangles;
    sum.statistics += found.statistics;
  }
  report(state, sum);
}

void BM_Retrieval(benchmark::State& state) {
  if (store_path().empty()) return state.SkipWithError("set ITIN_BENCHMARK_STORE");
  const Store store(store_path());
  const std::vector<Line> lines = lines_over(store, static_cast<double>(state.range(0)));
  run(state, lines, [&](Point2 a, Point2 b) { return cross_section(store, a, b, Detail::tolerance(0)); });
  state.counters["leaves_on_line"] = leaves_on(store, lines);
}
BENCHMARK(BM_Retrieval)->Arg(1000)->Arg(10000)->Arg(40000)->Unit(benchmark::kMicrosecond);

void BM_Cold(benchmark::State& state) {
  if (store_path().empty()) return state.SkipWithError("set ITIN_BENCHMARK_STORE");
  const std::vector<Line> lines = lines_over(Store(store_path()), 10000);
  std::size_t i = 0;
  for (auto _ : state) {
    const Store store(store_path());
    const auto& [a, b] = lines[i++ % lines.size()];
    benchmark::DoNotOptimize(cross_section(store, a, b, Detail::tolerance(0)).breakpoints.size());
  }
}
BENCHMARK(BM_Cold)->Unit(benchmark::kMillisecond);

void BM_Surface(benchmark::State& state) {
  if (store_path().empty()) return state.SkipWithError("set ITIN_BENCHMARK_STORE");
  const Store store(store_path());
  const SectionSurface surface(store, Detail::tolerance(0));
  run(state, lines_over(store, 10000), [&](Point2 a, Point2 b) { return surface.between(a, b); });
}
BENCHMARK(BM_Surface)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace itin
