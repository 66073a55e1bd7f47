// Adjacency and full topology of a window: the cost per triangle, on a square lattice in Morton order.
#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/topology.hpp>

#include "geometry/cell.hpp"

namespace itin {
namespace {

/// side x side vertices, each square cut along one diagonal.
Tin lattice_tin(std::int32_t side) {
  std::vector<std::uint64_t> codes;
  for (std::int32_t y = 0; y < side; ++y)
    for (std::int32_t x = 0; x < side; ++x) codes.push_back(morton(x, y));
  std::sort(codes.begin(), codes.end());
  std::vector<std::uint32_t> index(codes.size());
  Tin tin;
  for (const std::uint64_t code : codes) {
    const GridPoint p{morton_x(code), morton_y(code), 0};
    index[static_cast<std::size_t>(p.y * side + p.x)] = static_cast<std::uint32_t>(tin.vertices.size());
    tin.vertices.push_back(p);
  }
  tin.sources.assign(tin.vertices.size(), 0);
  for (std::int32_t y = 0; y + 1 < side; ++y) {
    for (std::int32_t x = 0; x + 1 < side; ++x) {
      const auto at = [&](std::int32_t dx, std::int32_t dy) {
        return index[static_cast<std::size_t>((y + dy) * side + x + dx)];
      };
      tin.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      tin.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  for (Triangle& t : tin.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(tin.triangles.begin(), tin.triangles.end());
  return tin;
}

void count_triangles(benchmark::State& state, const Tin& tin) {
  const auto triangles = static_cast<double>(tin.triangles.size());
  state.counters["triangles"] = triangles;
  state.counters["time_per_triangle"] =
      benchmark::Counter(triangles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_AdjacentTriangles(benchmark::State& state) {
  const Tin tin = lattice_tin(static_cast<std::int32_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(adjacent_triangles(tin));
  count_triangles(state, tin);
}
BENCHMARK(BM_AdjacentTriangles)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

void BM_Topology(benchmark::State& state) {
  const Tin tin = lattice_tin(static_cast<std::int32_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(Topology(tin));
  count_triangles(state, tin);
}
BENCHMARK(BM_Topology)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace itin
