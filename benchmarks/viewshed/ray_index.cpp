// An index of visibility by rays with each set of instructions, which have to give the same bytes: 16,384 observers
// near Cardiff, who look 10 km far along 64 rays.
#include "index/ray_index.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

#include <benchmark/benchmark.h>

#include <itin/import.hpp>

namespace itin::viewshed {
namespace {

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void BM_RaysOfAnIndex(benchmark::State& state, Instructions instructions) {
  const auto here = instructions_here();
  if (std::find(here.begin(), here.end(), instructions) == here.end())
    return state.SkipWithError("this machine has no such instructions");
  const std::string path =
      (std::filesystem::temp_directory_path() / ("itin-rays-" + std::to_string(getpid()) + ".itin")).string();
  NoProgress progress;
  ImportOptions terrain;
  terrain.sources = {std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/cardiff.tif"};
  import_terrain(path, terrain, progress);
  const Store store(path);
  const IndexRequest request{
      .area = Window::box({315000, 185000, 321400, 191400}), .cell_size = 50, .radius = 10000, .rays = 64};
  const IndexLayout layout = lay_out_index(store, request, progress);
  const auto look = [&](Instructions with) {
    return index_part_by_rays(store, request, layout, all_cells(layout.grid), progress, with);
  };
  const IndexPart expected = look(Instructions::kBaseline);
  std::uint64_t looks = 0;
  for (auto _ : state) {
    const IndexPart part = look(instructions);
    looks += part.counts.lines;
    if (!same_bytes(part.shares.share, expected.shares.share) ||
        !same_bytes(part.shares.standard_error, expected.shares.standard_error) ||
        part.counts.seen_of_ray != expected.counts.seen_of_ray)
      state.SkipWithError("other bytes than those of the baseline");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(looks));
  std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(BM_RaysOfAnIndex, baseline, Instructions::kBaseline)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(BM_RaysOfAnIndex, avx2, Instructions::kAvx2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(BM_RaysOfAnIndex, avx512, Instructions::kAvx512)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace itin::viewshed
