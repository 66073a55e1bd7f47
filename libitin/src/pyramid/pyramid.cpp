#include "pyramid/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <itin/parallel.hpp>

#include "pyramid/certify.hpp"
#include "pyramid/coverage.hpp"
#include "pyramid/leaf_cutter.hpp"
#include "pyramid/proposal.hpp"
#include "pyramid/replacement.hpp"
#include "pyramid/working_index.hpp"

namespace itin {

namespace {

/// Points a tile of greedy insertion: few borders, but still enough tiles for all threads.
std::uint32_t tile_points(std::uint64_t points) {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(points / 32, 1 << 15, 1 << 18));
}

std::vector<std::array<double, 4>> gap_bases(const std::vector<SourceInfo>& sources, const Grid& grid) {
  std::vector<std::array<double, 4>> bases;
  for (const SourceInfo& source : sources) {
    bases.push_back(source.gap_basis);
    for (double& component : bases.back()) component /= grid.resolution;
  }
  return bases;
}

/// Writes one level's quadtree; its leaves take the bounds of the working leaves in them.
class LevelWriter {
 public:
  LevelWriter(const WorkingIndex& index, const LeafBounds& bounds, int level, StoreWriter& writer)
      : index_(index),
        bounds_(bounds),
        level_(level),
        writer_(writer),
        cutter_(kLeafCapacity, [this](const Cell& cell, std::uint32_t count) { write(cell, count); }) {}
  LevelWriter(const LevelWriter&) = delete;

  void add(const RawPoint& p) {
    points_.push_back({morton_x(p.code), morton_y(p.code), p.z});
    sources_.push_back(p.source);
    cutter_.add(p.code);
  }
  void finish() { cutter_.finish(); }

 private:
  void write(const Cell& cell, std::uint32_t count) {
    // The working tree is the finer one: it holds every level's points and has the same capacity.
    DifferenceRange range;
    for (; leaf_ < index_.ranges().size() && index_.ranges()[leaf_].cell.code < cell.end(); ++leaf_)
      range.add(bounds_.at(leaf_, level_));
    if (count == 0 && range.empty()) return;
    if (range.empty()) range = {0, 0};
    writer_.add_leaf(level_, cell, std::span(points_).first(count), std::span(sources_).first(count), range.lo,
                     range.hi);
    points_.erase(points_.begin(), points_.begin() + count);
    sources_.erase(sources_.begin(), sources_.begin() + count);
  }

  const WorkingIndex& index_;
  const LeafBounds& bounds_;
  int level_;
  StoreWriter& writer_;
  std::vector<GridPoint> points_;
  std::vector<std::uint16_t> sources_;
  std::uint32_t leaf_ = 0;
  LeafCutter<std::function<void(const Cell&, std::uint32_t)>> cutter_;
};

void write_levels(const WorkingIndex& index, LeafBounds& bounds, const std::vector<CurveRange>& tiles, int levels,
                  StoreWriter& writer, PyramidReport& report, Progress& progress) {
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) {
    // The full surface differs from itself by nothing, wherever there is ground.
    if (levels > 1 && !bounds.at(leaf, 1).empty()) bounds.at(leaf, 0) = {0, 0};
  }
  std::size_t done = 0;
  for (int k = 0; k < levels; ++k) {
    LevelWriter level(index, bounds, k, writer);
    for (const CurveRange& tile : tiles) {
      progress.throw_if_cancelled();
      for (const RawPoint& p : index.read(tile)) {
        if (p.level != k) continue;
        level.add(p);
        report.vertices_of_source[p.source] += 1;
      }
      progress.report("writing", static_cast<double>(++done) /
                                     static_cast<double>(tiles.size() * static_cast<std::size_t>(levels)));
    }
    level.finish();
  }
}

}  // namespace

PyramidReport build_pyramid(SortedPoints& points, const std::vector<SourceInfo>& sources, const Grid& grid,
                            const std::vector<double>& tolerances, StoreWriter& writer, Progress& progress) {
  const int levels = static_cast<int>(tolerances.size());
  WorkingIndex index(points, levels, kLeafCapacity);
  const std::vector<CurveRange> tiles = index.tiles(tile_points(points.size()));
  PyramidReport report;
  report.vertices_of_source.assign(sources.size(), 0);

  std::vector<double> in_units;
  std::vector<std::int32_t> in_whole_units;
  for (const double metres : tolerances) {
    in_whole_units.push_back(static_cast<std::int32_t>(std::floor(metres / grid.resolution + 1e-9)));
    in_units.push_back(in_whole_units.back());
  }
  const std::vector<std::array<double, 4>> bases = gap_bases(sources, grid);
  report.replaced = drop_replaced(index, tiles, sources, bases, progress);
  Proposal proposal = propose_levels(index, tiles, bases, in_units, progress);
  report.isolated = index.drop(std::move(proposal.isolated));
  index.set_segments(join_collinear(std::move(proposal.outline)));

  LeafBounds bounds = certify(index, in_whole_units, progress);
  write_levels(index, bounds, tiles, levels, writer, report, progress);
  writer.add_segments(index.all_segments());
  return report;
}

}  // namespace itin
