// Decompression of lidar: points per second and core, of real tiles in ../shared/data.
//
//   itin_benchmarks --benchmark_filter=Laz
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "import/lidar/las_file.hpp"

namespace itin {
namespace {

void laz(benchmark::State& state, const std::string& name) {
  const std::string path = std::string(ITIN_DATA_DIR) + "/" + name;
  if (!std::filesystem::exists(path)) return state.SkipWithError((path + " is absent").c_str());
  const LasFile file(path);
  for (auto _ : state) {
    double heights = 0;
    file.read([&](std::span<const LasPoint> points, double) {
      for (const LasPoint& point : points) heights += point.z;
    });
    benchmark::DoNotOptimize(heights);
  }
  // Processor time is that of all threads, so that this is a rate for each core.
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(file.header().point_count));
}

BENCHMARK_CAPTURE(laz, LazFormat1, "ahn3-bgt-delft/ahn3/ahn3_cropped_1.laz")->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(laz, LazFormat1WithExtraBytes, "lidr-small/MixedConifer.laz")->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(laz, LazFormat6, "ign-lidarhd-0299-0300/pointcloud/test_semis_2023_0299_6802_LA93_IGN69.laz")
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace itin
