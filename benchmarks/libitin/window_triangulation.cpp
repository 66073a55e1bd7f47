// A window of a million points at full detail, from the closed store to triangles, against CGAL's Delaunay
// triangulation of the same points in memory by one thread (the kernel most users take: exact predicates, inexact
// constructions).
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <itin/import.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

namespace {

constexpr int kSide = 1000;

/// Hills of fixed shape at half-metre lattice offsets, or scattered about the lattice by a fixed hash.
std::string make_store(bool scattered) {
  const std::filesystem::path directory = std::filesystem::temp_directory_path();
  const std::string name = scattered ? "itin-benchmark-scattered" : "itin-benchmark-lattice";
  const std::string store = (directory / (name + ".itin")).string(), text = (directory / (name + ".csv")).string();
  if (std::filesystem::exists(store)) return store;
  std::ofstream out(text);
  out << "x,y,z\n";
  unsigned hash = 1;
  const auto jitter = [&] {
    hash = hash * 1664525u + 1013904223u;
    return scattered ? (hash >> 8) % 4000 * 0.01 : 0.0;
  };
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double z =
          300 + 150 * std::sin(column * 0.021) * std::cos(row * 0.017) + 20 * std::sin(column * 0.21 + row * 0.13);
      out << 300000 + 50 * column + jitter() << ',' << 200000 + 50 * row + jitter() << ',' << std::round(z * 10) / 10
          << '\n';
    }
  }
  out.close();
  itin::ImportOptions options;
  options.sources = {text};
  options.crs = "EPSG:27700";
  itin::NoProgress progress;
  itin::import_terrain(store, options, progress);
  std::filesystem::remove(text);
  return store;
}

void window_of_a_million(benchmark::State& state) {
  const std::string path = make_store(state.range(0) != 0);
  itin::set_thread_count(static_cast<int>(state.range(1)));
  itin::NoProgress progress;
  std::int64_t vertices = 0;
  for (auto _ : state) {
    const itin::Store store(path);
    const itin::Tin tin = itin::triangulate(store, itin::Window::all(), itin::Detail::tolerance(0), progress);
    benchmark::DoNotOptimize(tin.triangles.data());
    state.counters["read_per_point"] =
        static_cast<double>(tin.statistics.points_read) / static_cast<double>(tin.vertices.size());
    vertices += static_cast<std::int64_t>(tin.vertices.size());
  }
  state.SetItemsProcessed(vertices);
  itin::set_thread_count(0);
}
BENCHMARK(window_of_a_million)
    ->ArgNames({"scattered", "threads"})
    ->ArgsProduct({{0, 1}, {1, 0}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Reads that window where only its posts are wanted.
void posts_of_a_million(benchmark::State& state) {
  const std::string path = make_store(false);
  itin::set_thread_count(static_cast<int>(state.range(0)));
  itin::NoProgress progress;
  std::int64_t posts = 0;
  for (auto _ : state) {
    const itin::Store store(path);
    const auto lattice =
        itin::triangulate_lattice(store, itin::Window::all(), itin::ThemeChoice::none(), 2 * kSide * kSide, progress);
    if (!lattice) {
      state.SkipWithError("this is no lattice");
      break;
    }
    benchmark::DoNotOptimize(lattice->tiles.data());
    posts += static_cast<std::int64_t>(kSide) * kSide;
  }
  state.SetItemsProcessed(posts);
  itin::set_thread_count(0);
}
BENCHMARK(posts_of_a_million)->ArgName("threads")->Arg(1)->Arg(0)->UseRealTime()->Unit(benchmark::kMillisecond);

void cgal_of_a_million(benchmark::State& state) {
  using Triangulation = CGAL::Delaunay_triangulation_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
  const itin::Store store(make_store(state.range(0) != 0));
  itin::NoProgress progress;
  const itin::Tin tin = itin::triangulate(store, itin::Window::all(), itin::Detail::tolerance(0), progress);
  std::vector<Triangulation::Point> points;
  for (const itin::GridPoint& p : tin.vertices) points.emplace_back(p.x, p.y);
  for (auto _ : state) {
    Triangulation triangulation(points.begin(), points.end());
    benchmark::DoNotOptimize(triangulation.number_of_faces());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK(cgal_of_a_million)->ArgName("scattered")->Arg(0)->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
