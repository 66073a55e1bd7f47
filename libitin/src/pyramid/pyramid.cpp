#include "pyramid/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <itin/detail.hpp>
#include <itin/parallel.hpp>

#include "features/line_hierarchy.hpp"
#include "pyramid/certify.hpp"
#include "pyramid/contour_repair.hpp"
#include "pyramid/coverage.hpp"
#include "pyramid/part_masks.hpp"
#include "pyramid/proposal.hpp"
#include "pyramid/replacement.hpp"
#include "pyramid/set_points_aside.hpp"
#include "pyramid/working_index.hpp"
#include "store/lateral_tolerance.hpp"
#include "store/leaf_cutter.hpp"

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

/// The codes of the vertices of the terrain's lines, ascending, as those are in Morton order.
std::vector<std::uint64_t> terrain_codes(const ThemeLines& lines) {
  std::vector<std::uint64_t> codes;
  for (const std::uint32_t v : lines.terrain_vertices()) codes.push_back(code_of(lines.lines.vertices[v]));
  return codes;
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
  std::vector<Segment> whole = placed.features;
  whole.insert(whole.end(), placed.standing.begin(), placed.standing.end());
  return LineHierarchy(placed.terrain, whole, nodes, height, by_level);
}

std::vector<Segment> of_kind(const std::vector<Segment>& segments, ThemeKind kind, const ThemeLines& lines) {
  std::vector<Segment> result;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(result),
               [&](const Segment& s) { return lines.kinds[s.theme - std::size_t{1}] == kind; });
  return result;
}

/// The flat triangles of the surface that all points, the outline and the terrain's lines make.
FlatSurvey survey_flat(WorkingIndex& index, const std::vector<CurveRange>& tiles, const PlacedLines& placed,
                       const std::vector<Segment>& outline, const ThemeLines& lines, Progress& progress) {
  std::vector<Segment> segments = outline;
  segments.insert(segments.end(), placed.terrain.begin(), placed.terrain.end());
  index.set_segments(std::move(segments));
  return FlatSurvey(index, tiles, of_kind(placed.terrain, ThemeKind::Contours, lines),
                    of_kind(placed.terrain, ThemeKind::Water, lines), progress);
}

std::vector<RawPoint> raw_points(const std::vector<GridPoint>& points, std::size_t source) {
  std::vector<RawPoint> result;
  for (const GridPoint& p : points) result.push_back({morton(p.x, p.y), p.z, static_cast<std::uint16_t>(source), 0});
  return result;
}

/// The vertices that each theme has besides those of the full surface, with the themes they belong to. `crossings`:
/// those of lines that keep the ground with other lines.
void write_features(const PlacedLines& placed, const std::vector<ThemeVertex>& crossings, const ThemeLines& lines,
                    const std::vector<GridPoint>& draped, StoreWriter& writer, PyramidReport& report) {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> ends;  // theme, code
  for (const Segment& s : placed.features) {
    ends.emplace_back(s.theme, morton(s.ax, s.ay));
    ends.emplace_back(s.theme, morton(s.bx, s.by));
  }
  for (const auto& [theme, code] : crossings) ends.emplace_back(theme + 1, code);
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
  for (const std::vector<Segment>* segments : {&placed.terrain, &placed.features, &placed.standing}) {
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

/// A vertex that covers a point of the ground stands for it while levels are made, and is its line's in the store.
std::uint16_t own_source(const RawPoint& p, const std::vector<CoveredPoint>& covered) {
  const auto at = std::lower_bound(covered.begin(), covered.end(), p.code,
                                   [](const CoveredPoint& c, std::uint64_t code) { return c.point.code < code; });
  return at != covered.end() && at->point.code == p.code ? at->line : p.source;
}

void write_levels(const WorkingIndex& index, LeafBounds& bounds, const std::vector<CurveRange>& tiles, int levels,
                  const std::vector<CoveredPoint>& covered, StoreWriter& writer, PyramidReport& report,
                  Progress& progress) {
  for (std::uint32_t leaf = 0; leaf < index.ranges().size(); ++leaf) {
    // The full surface differs from itself by nothing, wherever there is ground.
    if (levels > 1 && !bounds.at(leaf, 1).empty()) bounds.at(leaf, 0) = {0, 0};
  }
  std::size_t done = 0;
  for (int k = 0; k < levels; ++k) {
    LevelWriter level(index, bounds, k, writer);
    for (const CurveRange& tile : tiles) {
      progress.throw_if_cancelled();
      for (RawPoint p : index.read(tile)) {
        if (p.level != k) continue;
        p.source = own_source(p, covered);
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

bool is_ground(const SourceInfo& source) {
  return source.theme.empty() ? source.kind != kInferred : source.kind == name_of(ThemeKind::Contours);
}

PyramidReport build_pyramid(SortedPoints& points, const std::vector<SourceInfo>& sources, const Grid& grid,
                            const std::vector<double>& tolerances, const ThemeLines& lines,
                            const std::vector<GridPoint>* inferred, StoreWriter& writer, Progress& progress) {
  const int levels = static_cast<int>(tolerances.size());
  std::optional<SortedPoints> imported;  // all of them, where `points` has become those of the surface
  std::optional<WorkingIndex> working(std::in_place, points, levels, kLeafCapacity);
  std::vector<CurveRange> tiles = working->tiles(tile_points(points.size()));
  PyramidReport report;
  report.vertices_of_source.assign(sources.size(), 0);

  std::vector<double> in_units;
  std::vector<std::int32_t> in_whole_units;
  for (const double metres : tolerances) {
    in_whole_units.push_back(static_cast<std::int32_t>(std::floor(metres / grid.resolution + 1e-9)));
    in_units.push_back(in_whole_units.back());
  }
  const std::vector<std::array<double, 4>> bases = gap_bases(sources, grid);
  Sources ground;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (is_ground(sources[s])) ground.insert(static_cast<std::uint16_t>(s));
  }
  const Sources* const only = ground.size() < sources.size() ? &ground : nullptr;
  report.replaced = drop_replaced(*working, tiles, sources, bases, terrain_codes(lines), progress);
  Proposal proposal = lines.empty() ? propose_levels(*working, tiles, bases, in_units, progress)
                                    : find_ground(*working, tiles, bases, only, progress);
  report.isolated = working->drop(std::move(proposal.isolated));
  const std::vector<Segment> outline = join_collinear(std::move(proposal.outline));
  PlacedLines placed;
  if (!lines.empty()) {
    placed = place_lines(lines, *working, tiles, ground, bases, outline, progress);
    working->drop(placed.strays);
  }
  if (!of_kind(placed.terrain, ThemeKind::Contours, lines).empty()) {
    const FlatSurvey flat = survey_flat(*working, tiles, placed, outline, lines, progress);
    report.flat_before = report.flat_after = flat.triangles();
    const auto source = std::find_if(sources.begin(), sources.end(), [](const auto& s) { return s.kind == kInferred; });
    if (source != sources.end()) {
      SortedPoints with = points.with(raw_points(inferred != nullptr ? *inferred : flat.inferred(),
                                                 static_cast<std::size_t>(source - sources.begin())),
                                      kDropped);
      imported = std::exchange(points, std::move(with));
      working.emplace(points, levels, kLeafCapacity);
      tiles = working->tiles(tile_points(points.size()));
      report.flat_after = survey_flat(*working, tiles, placed, outline, lines, progress).triangles();
    }
  }
  WorkingIndex& index = *working;
  placed.standing = standing_segments(lines);
  placed.ground = ground_segments(lines);
  std::optional<LineHierarchy> hierarchy = generalised(placed, outline, lines, in_units);
  const auto set_lines = [&] {
    std::vector<Segment> segments = outline;
    if (hierarchy) {
      for (const auto& [code, level] : hierarchy->levels()) index.promote(code, level);
      const std::vector<Segment> of_lines = hierarchy->segments();
      segments.insert(segments.end(), of_lines.begin(), of_lines.end());
    }
    index.set_segments(std::move(segments));
  };
  set_lines();
  if (!lines.empty()) {
    std::vector<Segment> whole = outline;
    whole.insert(whole.end(), placed.features.begin(), placed.features.end());
    for (const Segment& s : whole) {
      index.promote(morton(s.ax, s.ay), levels - 1);
      index.promote(morton(s.bx, s.by), levels - 1);
    }
    propose_levels_with_lines(index, tiles, in_units, progress);
  }

  const auto restore = [&](const std::vector<FailedPlace>& failed) {
    bool any = false;
    for (const FailedPlace& place : failed) any |= hierarchy && hierarchy->restore(place.box, place.level);
    if (!any) return false;
    set_lines();
    return true;
  };
  LeafBounds bounds = certify(index, in_whole_units, restore, progress);
  const SortedPoints& whole_ground = imported ? *imported : points;
  write_levels(index, bounds, tiles, levels, whole_ground.covered(), writer, report, progress);
  std::vector<GridPoint> draped;
  const std::vector<ThemeVertex> crossings = crossings_of_ground(lines);
  if (!placed.features.empty() || !crossings.empty()) {
    std::vector<std::uint64_t> ends = placed.ends;
    for (const ThemeVertex& v : crossings) ends.push_back(v.code);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    draped = drape(ends, index, tiles, progress);
    write_features(placed, crossings, lines, draped, writer, report);
  }
  count_lines(placed, lines.themes() + lines.parts.size(), report);
  std::vector<Segment> segments = index.all_segments();
  segments.insert(segments.end(), placed.features.begin(), placed.features.end());
  segments.insert(segments.end(), placed.standing.begin(), placed.standing.end());
  segments.insert(segments.end(), placed.ground.begin(), placed.ground.end());
  const std::vector<Segment> masked = write_parts(lines, index, tiles, draped, segments, writer, progress);
  for (std::size_t p = 0; p < lines.parts.size(); ++p) {
    report.line_vertices[lines.themes() + p] = lines.parts[p].vertices.size();
    report.vertices_of_source[lines.parts[p].source] += lines.parts[p].vertices.size();
  }
  segments.insert(segments.end(), masked.begin(), masked.end());
  writer.add_segments(segments);
  set_points_aside(whole_ground, sources, writer, progress);
  report.placed = std::move(placed.terrain);
  report.placed.insert(report.placed.end(), placed.features.begin(), placed.features.end());
  return report;
}

}  // namespace itin
