#include "pyramid/pyramid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <optional>

#include <itin/detail.hpp>
#include <itin/parallel.hpp>

#include "features/line_hierarchy.hpp"
#include "pyramid/certify.hpp"
#include "pyramid/coverage.hpp"
#include "pyramid/greedy.hpp"
#include "pyramid/replacement.hpp"
#include "pyramid/working_index.hpp"
#include "store/leaf_cutter.hpp"

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

/// The levels that lines and outline ask of vertices.
class LineLevels {
 public:
  void add(std::uint64_t code, int level) { levels_.emplace_back(code, static_cast<std::uint8_t>(level)); }
  void finish() { std::sort(levels_.begin(), levels_.end()); }
  /// The greatest; 0 where nothing was asked.
  std::uint8_t of(std::uint64_t code) const {
    const auto after = std::upper_bound(levels_.begin(), levels_.end(), std::pair(code, std::uint8_t{0xff}));
    return after != levels_.begin() && std::prev(after)->first == code ? std::prev(after)->second : std::uint8_t{0};
  }

 private:
  std::vector<std::pair<std::uint64_t, std::uint8_t>> levels_;
};

/// Writes the levels that a tile's points should have.
void write_proposals(WorkingIndex& index, const CurveRange& tile, const RegionMesh& surface,
                     std::span<const Candidacy> candidacy, std::span<const double> tolerances,
                     std::span<const std::uint8_t> floors = {}) {
  const std::vector<std::uint8_t> levels = greedy_levels(surface, candidacy, tolerances, floors);
  std::vector<RawPoint> points = index.read(tile);
  std::size_t v = 0;
  for (RawPoint& p : points) {
    while (v < levels.size() && morton(surface.vertices[v].point.x, surface.vertices[v].point.y) < p.code) ++v;
    if (v == levels.size()) break;
    if (p.level != kDropped && morton(surface.vertices[v].point.x, surface.vertices[v].point.y) == p.code)
      p.level = levels[v];
  }
  index.write(tile, points);
}

/// The same where lines are part of the surface.
void propose_levels(WorkingIndex& index, const CurveRange& tile, const LineLevels& line_levels,
                    std::span<const double> tolerances) {
  std::vector<RawPoint> own = index.read(tile);
  std::erase_if(own, [](const RawPoint& p) { return p.level == kDropped; });
  const GridBox box = with_fringe(own);
  // Greedy insertion walks straight across voids, so it wants triangles there as well.
  Selection selection(Detail::tolerance(0), {0.0}, Grid{});
  selection.leave_out(kCoverage);
  const RegionMesh surface = triangulate_region(index, selection, box);
  std::vector<Candidacy> candidacy;
  std::vector<std::uint8_t> floors;
  for (const SelectedVertex& v : surface.vertices) {
    const bool in_box = box.contains(v.point.x, v.point.y);
    floors.push_back(line_levels.of(morton(v.point.x, v.point.y)));
    const bool corner = in_box && floors.back() + std::size_t{1} == tolerances.size();
    candidacy.push_back(corner ? Candidacy::kCorner : in_box ? Candidacy::kFree : Candidacy::kNone);
  }
  write_proposals(index, tile, surface, candidacy, tolerances, floors);
}

/// Sources whose points are ground by themselves: all but lines that add to it.
Sources ground_sources(const std::vector<SourceInfo>& sources) {
  Sources ground;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (sources[s].theme.empty() || sources[s].kind == name_of(ThemeKind::Contours))
      ground.insert(static_cast<std::uint16_t>(s));
  }
  return ground;
}

/// The lines of the terrain at all levels; nothing where there are none.
std::optional<LineHierarchy> generalised(const PlacedLines& placed, const std::vector<Segment>& outline,
                                         const ThemeLines& lines, const std::vector<double>& tolerances) {
  if (placed.terrain.empty()) return std::nullopt;
  std::vector<LineTolerance> by_level;
  for (const double t : tolerances) by_level.push_back({t, lateral_tolerance(t)});
  std::vector<std::uint64_t> nodes = placed.on_outline;
  for (const Segment& s : outline) {
    nodes.push_back(morton(s.ax, s.ay));
    nodes.push_back(morton(s.bx, s.by));
  }
  const auto height = [&](Position p) {
    const auto at = std::lower_bound(lines.lines.vertices.begin(), lines.lines.vertices.end(), morton(p.x, p.y),
                                     [](const GridPoint& v, std::uint64_t code) { return morton(v.x, v.y) < code; });
    return at->z;
  };
  return LineHierarchy(placed.terrain, placed.features, nodes, height, by_level);
}

/// Runs work(i) for every tile, in parallel.
template <class Work>
void for_each_tile(const std::vector<CurveRange>& tiles, const char* stage, Progress& progress, const Work& work) {
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    work(i);
    progress.report(stage, static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
}

/// The vertices that each theme has besides those of the full surface, with the themes they belong to.
void write_features(const PlacedLines& placed, const ThemeLines& lines, const std::vector<GridPoint>& draped,
                    StoreWriter& writer, PyramidReport& report) {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> ends;  // theme, code
  for (const Segment& s : placed.features) {
    ends.emplace_back(s.theme, morton(s.ax, s.ay));
    ends.emplace_back(s.theme, morton(s.bx, s.by));
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto by_code = [](const GridPoint& p, std::uint64_t code) { return morton(p.x, p.y) < code; };
  for (auto at = ends.begin(); at != ends.end();) {
    const std::uint16_t theme = at->first;
    std::vector<GridPoint> points;
    std::vector<std::uint16_t> sources;
    for (; at != ends.end() && at->first == theme; ++at) {
      const auto point = std::lower_bound(draped.begin(), draped.end(), at->second, by_code);
      if (point == draped.end() || morton(point->x, point->y) != at->second) continue;
      const auto vertex =
          std::lower_bound(lines.lines.vertices.begin(), lines.lines.vertices.end(), at->second, by_code);
      points.push_back(*point);
      sources.push_back(lines.sources[static_cast<std::size_t>(vertex - lines.lines.vertices.begin())]);
      report.vertices_of_source[sources.back()] += 1;
    }
    writer.add_theme_vertices(theme, points, sources);
  }
}

void count_lines(const PlacedLines& placed, std::size_t themes, PyramidReport& report) {
  std::vector<std::vector<std::uint64_t>> ends(themes);
  report.segments.assign(themes, 0);
  report.left_out = placed.left_out;
  for (const std::vector<Segment>* segments : {&placed.terrain, &placed.features}) {
    for (const Segment& s : *segments) {
      report.segments[s.theme - std::size_t{1}] += 1;
      ends[s.theme - std::size_t{1}].push_back(morton(s.ax, s.ay));
      ends[s.theme - std::size_t{1}].push_back(morton(s.bx, s.by));
    }
  }
  for (std::vector<std::uint64_t>& codes : ends) {
    std::sort(codes.begin(), codes.end());
    report.line_vertices.push_back(static_cast<std::uint64_t>(std::unique(codes.begin(), codes.end()) - codes.begin()));
  }
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
                            const std::vector<double>& tolerances, const ThemeLines& lines, StoreWriter& writer,
                            Progress& progress) {
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
  const Sources ground = ground_sources(sources);
  const Sources* const only = ground.size() < sources.size() ? &ground : nullptr;
  report.replaced = drop_replaced(index, tiles, sources, bases, progress);
  std::vector<Proposals> proposals(tiles.size());
  for_each_tile(tiles, lines.empty() ? "choosing the levels" : "finding the ground", progress, [&](std::size_t i) {
    TileSurvey survey = survey_tile(index, tiles[i], bases, only);
    if (lines.empty()) write_proposals(index, tiles[i], survey.surface, survey.candidacy, in_units);
    proposals[i] = {std::move(survey.outline), std::move(survey.isolated)};
  });
  std::vector<Segment> outline;
  std::vector<std::uint64_t> isolated;
  for (const Proposals& p : proposals) {
    outline.insert(outline.end(), p.outline.begin(), p.outline.end());
    isolated.insert(isolated.end(), p.isolated.begin(), p.isolated.end());
  }
  report.isolated = index.drop(std::move(isolated));
  outline = join_collinear(std::move(outline));
  PlacedLines placed;
  if (!lines.empty()) {
    placed = place_lines(lines, index, tiles, ground, bases, outline, progress);
    index.drop(placed.strays);
  }
  std::optional<LineHierarchy> hierarchy = generalised(placed, outline, lines, in_units);
  const auto set_segments = [&] {
    std::vector<Segment> segments = outline;
    const std::vector<Segment> of_lines = hierarchy ? hierarchy->segments() : std::vector<Segment>{};
    segments.insert(segments.end(), of_lines.begin(), of_lines.end());
    index.set_segments(std::move(segments));
  };
  set_segments();
  if (!lines.empty()) {
    LineLevels line_levels;
    for (const Segment& s : outline) line_levels.add(morton(s.ax, s.ay), levels - 1);
    for (const Segment& s : outline) line_levels.add(morton(s.bx, s.by), levels - 1);
    for (const Segment& s : placed.features) line_levels.add(morton(s.ax, s.ay), levels - 1);
    for (const Segment& s : placed.features) line_levels.add(morton(s.bx, s.by), levels - 1);
    if (hierarchy) {
      for (const auto& [code, level] : hierarchy->levels()) line_levels.add(code, level);
    }
    line_levels.finish();
    for_each_tile(tiles, "choosing the levels", progress,
                  [&](std::size_t i) { propose_levels(index, tiles[i], line_levels, in_units); });
  }

  const auto restore = [&](const std::vector<FailedPlace>& failed) {
    bool any = false;
    for (const FailedPlace& place : failed) any |= hierarchy && hierarchy->restore(place.box, place.level);
    if (!any) return false;
    for (const auto& [code, level] : hierarchy->levels()) index.promote(code, level);
    set_segments();
    return true;
  };
  LeafBounds bounds = certify(index, in_whole_units, restore, progress);
  write_levels(index, bounds, tiles, levels, writer, report, progress);
  if (!placed.features.empty())
    write_features(placed, lines, drape(placed.ends, index, tiles, progress), writer, report);
  count_lines(placed, lines.terrain.size(), report);
  std::vector<Segment> segments = index.all_segments();
  segments.insert(segments.end(), placed.features.begin(), placed.features.end());
  writer.add_segments(std::move(segments));
  return report;
}

}  // namespace itin
