// Block codec: points per second both ways, and bytes per point, on synthetic terrain like the real thing.
//
//   itin_benchmarks --benchmark_filter=Block
#include "store/codec/block_codec.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "geometry/cell.hpp"
#include "libitin/hills.hpp"

namespace itin {
namespace {

struct Sample {
  Cell cell;
  std::vector<GridPoint> points;
  std::vector<std::uint16_t> sources;
};

enum class Points { kFullLattice, kLattice, kScattered };

std::vector<Sample> sample(Points how) {
  const bool lattice = how != Points::kScattered;
  std::mt19937_64 random(1);
  std::vector<Sample> samples;
  for (int k = 0; k < 256; ++k) {
    Sample s{{morton((k % 16) << 17, (k / 16) << 17), 17}, {}, {}};
    std::vector<std::uint64_t> codes;
    if (lattice) {  // 50 m posts in decimetres, of which a coarse level has 6 in 10
      for (std::int32_t y = 1250; y < 1 << 17; y += 5000) {
        for (std::int32_t x = 3300; x < 1 << 17; x += 5000) {
          if (how == Points::kFullLattice || random() % 10 < 6)
            codes.push_back(morton(s.cell.box().xmin + x, s.cell.box().ymin + y));
        }
      }
    } else {  // lidar at 1 cm, 2.5 m apart
      s.cell.log2_side = 12;
      for (int i = 0; i < 270; ++i) codes.push_back(s.cell.code + random() % (std::uint64_t{1} << 24));
    }
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    for (const std::uint64_t code : codes) {
      GridPoint p{morton_x(code), morton_y(code), 0};
      const double z = hill_height(p.x * 0.01, p.y * 0.01);
      p.z = lattice ? 10 * static_cast<std::int32_t>(std::lround(z * 10))
                    : static_cast<std::int32_t>(std::lround(z * 100)) + static_cast<std::int32_t>(random() % 9);
      s.points.push_back(p);
    }
    s.sources.assign(s.points.size(), 0);
    samples.push_back(std::move(s));
  }
  return samples;
}

std::int64_t count(const std::vector<Sample>& samples) {
  std::size_t n = 0;
  for (const Sample& s : samples) n += s.points.size();
  return static_cast<std::int64_t>(n);
}

void BlockEncode(benchmark::State& state, Points how) {
  const auto samples = sample(how);
  std::size_t bytes = 0;
  for (auto _ : state) {
    bytes = 0;
    for (const Sample& s : samples) bytes += encode_block(s.cell, s.points, s.sources).size();
  }
  state.SetItemsProcessed(state.iterations() * count(samples));
  state.counters["bytes_per_point"] = static_cast<double>(bytes) / static_cast<double>(count(samples));
}

std::vector<std::vector<std::uint8_t>> blocks_of(const std::vector<Sample>& samples) {
  std::vector<std::vector<std::uint8_t>> blocks;
  for (const Sample& s : samples) blocks.push_back(encode_block(s.cell, s.points, s.sources));
  return blocks;
}

/// As sweeps read rasters: heights alone, in rows.
void BlockHeights(benchmark::State& state) {
  const auto samples = sample(Points::kFullLattice);
  const auto blocks = blocks_of(samples);
  for (auto _ : state) {
    for (std::size_t i = 0; i < blocks.size(); ++i) benchmark::DoNotOptimize(decode_posts(samples[i].cell, blocks[i]));
  }
  state.SetItemsProcessed(state.iterations() * count(samples));
}

void BlockDecode(benchmark::State& state, Points how) {
  const auto samples = sample(how);
  const auto blocks = blocks_of(samples);
  for (auto _ : state) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      benchmark::DoNotOptimize(decode_block(samples[i].cell, blocks[i]));
    }
  }
  state.SetItemsProcessed(state.iterations() * count(samples));
}

BENCHMARK_CAPTURE(BlockEncode, full_lattice, Points::kFullLattice)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BlockEncode, dem_50m, Points::kLattice)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BlockEncode, lidar, Points::kScattered)->Unit(benchmark::kMillisecond);
BENCHMARK(BlockHeights)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BlockDecode, full_lattice, Points::kFullLattice)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BlockDecode, dem_50m, Points::kLattice)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BlockDecode, lidar, Points::kScattered)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace itin
