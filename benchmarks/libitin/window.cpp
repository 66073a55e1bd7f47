// The cost of deciding one triangle against a window, for triangles as small against the window as in a real query.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "triangulate/region/grid_window.hpp"

namespace itin {
namespace {

const Grid kGrid{{0, 0}, 0.01};

/// Triangles about 50 m across in the square of 12 km about the origin, most of them within a window of 5 km radius.
std::vector<GridPoint> triangles(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> place(-600000, 600000), offset(1000, 5000);
  std::vector<GridPoint> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const GridPoint a{place(random), place(random), 0};
    corners.insert(corners.end(), {a, {a.x + offset(random), a.y, 0}, {a.x, a.y + offset(random), 0}});
  }
  return corners;
}

void run(benchmark::State& state, const Window& window) {
  const GridWindow grid_window(window, kGrid, {});
  const std::vector<GridPoint> corners = triangles(1 << 16);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(grid_window.meets(corners[i], corners[i + 1], corners[i + 2]));
    i = i + 3 == corners.size() ? 0 : i + 3;
  }
}

void BM_MeetsBox(benchmark::State& state) {
  run(state, Window::box({-5000, -5000, 5000, 5000}));
}
BENCHMARK(BM_MeetsBox);
void BM_MeetsDisc(benchmark::State& state) {
  run(state, Window::disc({0, 0}, 5000));
}
BENCHMARK(BM_MeetsDisc);
void BM_MeetsCorridor(benchmark::State& state) {
  run(state, Window::corridor({-5000, -5000}, {5000, 5000}, 100));
}
BENCHMARK(BM_MeetsCorridor);

}  // namespace
}  // namespace itin
