#include "pyramid/pyramid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>

#include <itin/parallel.hpp>

#include "pyramid/certify.hpp"
#include "pyramid/coverage.hpp"
#include "pyramid/greedy.hpp"
#include "pyramid/leaf_cutter.hpp"
#include "pyramid/replacement.hpp"
#include "pyramid/working_index.hpp"

namespace itin {

namespace {

/// Points a tile of greedy insertion.
constexpr std::uint32_t kTilePoints = 1 << 16;

std::vector<std::array<double, 4>> gap_bases(const std::vector<SourceInfo>& sources, const Grid& grid) {
  std::vector<std::array<double, 4>> bases;
  for (const SourceInfo& source : sources) {
    bases.push_back(source.gap_basis);
    for (double& component : bases.back()) component /= grid.resolution;
  }
  return bases;
}

struct Proposals {
  std::vector<Segment> outline;
  std::vector<std::uint64_t> isolated;
};

/// Finds the tile's part of the coverage and writes the levels that its points should have.
Proposals propose_levels(WorkingIndex& index, const CurveRange& tile, const std::vector<std::array<double, 4>>& bases,
                         std::span<const double> tolerances) {
  TileSurvey survey = survey_tile(index, tile, bases);
  const std::vector<std::uint8_t> levels = greedy_levels(survey.surface, survey.candidacy, tolerances);
  std::vector<RawPoint> points = index.read(tile);
  std::size_t v = 0;
  for (RawPoint& p : points) {
    while (v < levels.size() && morton(survey.surface.vertices[v].point.x, survey.surface.vertices[v].point.y) < p.code)
      ++v;
    if (v == levels.size()) break;
    if (morton(survey.surface.vertices[v].point.x, survey.surface.vertices[v].point.y) == p.code) p.level = levels[v];
  }
  index.write(tile, points);
  return {std::move(survey.outline), std::move(survey.isolated)};
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
  const std::vector<CurveRange> tiles = index.tiles(kTilePoints);
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
  std::vector<Proposals> proposals(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    proposals[i] = propose_levels(index, tiles[i], bases, in_units);
    progress.report("choosing the levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  std::vector<Segment> outline;
  std::vector<std::uint64_t> isolated;
  for (const Proposals& p : proposals) {
    outline.insert(outline.end(), p.outline.begin(), p.outline.end());
    isolated.insert(isolated.end(), p.isolated.begin(), p.isolated.end());
  }
  report.isolated = index.drop(std::move(isolated));
  index.set_segments(join_collinear(std::move(outline)));

  LeafBounds bounds = certify(index, in_whole_units, progress);
  write_levels(index, bounds, tiles, levels, writer, report, progress);
  writer.add_segments(index.all_segments());
  return report;
}

}  // namespace itin
