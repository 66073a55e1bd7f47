// Choosing the levels of one tile of an import, by the posts of its lattice and by its triangles; vertices per second.
//
//   itin_benchmarks --benchmark_filter=Levels
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/detail.hpp>

#include "libitin/hills.hpp"
#include "pyramid/greedy/greedy.hpp"
#include "support/points.hpp"
#include "triangulate/region/region.hpp"

namespace itin {
namespace {

constexpr std::int32_t kSide = 256;
const std::vector<double> kTolerances{0, 50, 100, 200, 400, 800, 1600, 3200};  // centimetres

/// A tile of posts 50 m apart, where most are in some level, or 5 m apart, where few are.
struct Tile {
  explicit Tile(bool smooth) {
    const std::int32_t step = smooth ? 500 : 5000;
    std::vector<test::LevelPoint> points;
    for (std::int32_t y = 0; y < kSide * step; y += step) {
      for (std::int32_t x = 0; x < kSide * step; x += step)
        points.push_back({{x, y, static_cast<std::int32_t>(std::lround(100 * hill_height(x * 0.01, y * 0.01)))}, 0});
    }
    test::TestIndex index(points, 1, 512);
    surface = triangulate_region(*index, Selection(Detail::tolerance(0), {0.0}, Grid{}), index->bounds());
    candidacy.assign(surface.vertices.size(), Candidacy::kFree);
  }

  RegionMesh surface;
  std::vector<Candidacy> candidacy;
};

void count_vertices(benchmark::State& state, const Tile& tile) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tile.surface.vertices.size()));
}

void LevelsByPosts(benchmark::State& state) {
  const Tile tile(state.range(0) != 0);
  for (auto _ : state) {
    const auto posts = LatticePosts::of(tile.surface.vertices);
    benchmark::DoNotOptimize(greedy_levels(tile.surface.vertices, *posts, tile.candidacy, kTolerances));
  }
  count_vertices(state, tile);
}

void LevelsByTriangles(benchmark::State& state) {
  const Tile tile(state.range(0) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(greedy_levels(tile.surface, tile.candidacy, kTolerances));
  count_vertices(state, tile);
}

}  // namespace

BENCHMARK(LevelsByPosts)->ArgName("smooth")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(LevelsByTriangles)->ArgName("smooth")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace itin
