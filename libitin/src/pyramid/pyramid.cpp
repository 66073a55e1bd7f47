#include "pyramid/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/detail.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "features/contours/line_hierarchy.hpp"
#include "pyramid/contour_repair.hpp"
#include "pyramid/coverage/coverage.hpp"
#include "pyramid/level_writer.hpp"
#include "pyramid/levels/certify.hpp"
#include "pyramid/levels/post_hierarchy.hpp"
#include "pyramid/levels/proposal.hpp"
#include "pyramid/line_writer.hpp"
#include "pyramid/points/working_index.hpp"
#include "pyramid/replacement.hpp"
#include "pyramid/set_points_aside.hpp"
#include "store/segments/lateral_tolerance.hpp"

namespace itin {

namespace {

/// The codes of the vertices of the terrain's lines, ascending, since the vertices are in Morton order.
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
  nodes.insert(nodes.end(), placed.feature_ends.begin(), placed.feature_ends.end());
  for (const Segment& s : outline) {
    nodes.push_back(code_of(s.a()));
    nodes.push_back(code_of(s.b()));
  }
  const auto height = [&](Position p) { return find_by_code(lines.lines.vertices, code_of(p))->z; };
  std::vector<Segment> whole = placed.features;
  whole.insert(whole.end(), placed.raised.begin(), placed.raised.end());
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
  for (const GridPoint& p : points) result.push_back({code_of(p), p.z, static_cast<std::uint16_t>(source), 0});
  return result;
}

/// The source of a point in the store. A vertex that covers a point of the ground stands for it while levels are made,
/// and belongs to its line's source in the store.
std::uint16_t own_source(const RawPoint& p, const std::vector<CoveredPoint>& covered) {
  const auto at = std::lower_bound(covered.begin(), covered.end(), p.code,
                                   [](const CoveredPoint& c, std::uint64_t code) { return c.point.code < code; });
  return at != covered.end() && at->point.code == p.code ? at->line : p.source;
}

Sources ground_sources(const std::vector<SourceInfo>& sources) {
  Sources ground;
  for (std::size_t s = 0; s < sources.size(); ++s)
    if (is_ground(sources[s])) ground.insert(static_cast<std::uint16_t>(s));
  return ground;
}

void append(std::vector<Segment>& segments, const std::vector<Segment>& more) {
  segments.insert(segments.end(), more.begin(), more.end());
}

/// Builds a pyramid in numbered steps, each of which is run once and in this order.
class PyramidBuild {
 public:
  PyramidBuild(const PyramidSources& of, StoreWriter& writer, Progress& progress)
      : points_(of.points),
        sources_(of.sources),
        lines_(of.lines),
        inferred_(of.inferred),
        levels_(static_cast<int>(of.tolerances.size())),
        bases_(gap_bases_of(of.sources, of.grid)),
        writer_(writer),
        progress_(progress) {
    for (const double metres : of.tolerances) {
      whole_units_.push_back(static_cast<std::int32_t>(std::floor(metres / of.grid.resolution + 1e-9)));
      units_.push_back(whole_units_.back());
    }
    report_.vertices_of_source.assign(sources_.size(), 0);
    index_points();
  }

  PyramidReport run() {
    const bool alone = lines_.empty();
    drop_replaced_points();
    if (alone) find_fine_levels();
    progress_.step(!alone ? kGroundUnderLines : sea_ ? kGroundBesideSea : kGroundAlone);
    find_coverage();
    progress_.step(alone ? 0 : kLines);
    place();
    repair_contours();
    generalise();
    if (!alone) find_fine_levels();
    progress_.step(alone ? 0 : kProposal);
    propose_with_lines();
    progress_.step(kCertificates);
    LeafBounds bounds = certify_levels();
    progress_.step(1);
    write_ground(std::move(bounds));
    write_lines();
    set_points_aside(imported(), sources_, writer_, progress_);
    report_.placed = std::move(placed_.terrain);
    append(report_.placed, placed_.features);
    report_.of_features = std::move(placed_.of_features);
    return std::move(report_);
  }

 private:
  /// Vertices that are stored a second time are at most one in this many. Where a level has more of all vertices,
  /// reading all of them takes little longer than reading its own, which lie apart.
  static constexpr std::uint64_t kPointsPerCopy = 8;
  /// About the share that a step takes of the time that is left.
  static constexpr double kGroundAlone = 0.8, kGroundBesideSea = 0.4, kGroundUnderLines = 0.2, kLines = 0.1,
                          kReplacement = 0.05, kFineLevels = 0.15, kProposal = 0.7, kCertificates = 0.85;

  void index_points() {
    index_.emplace(points_, levels_, kLeafCapacity);
    tiles_ = index_->work_cells();
  }

  /// All points that were imported, even where the surface's points have become more.
  const SortedPoints& imported() const { return imported_ ? *imported_ : points_; }

  /// Drops points that make way for finer ones. It comes before all else that looks at points.
  void drop_replaced_points() {
    Progress& step = progress_.step(kReplacement);
    report_.replaced = drop_replaced(*index_, tiles_, sources_, bases_, terrain_codes(lines_), step);
  }

  /// Finds the fine levels of rasters; goes before the other levels are proposed.
  void find_fine_levels() {
    posts_in_squares_ = PostHierarchy(*index_, tiles_, whole_units_, progress_.step(kFineLevels));
  }

  /// Step 1: finds the coverage. Without lines the levels are proposed in the same go.
  void find_coverage() {
    const Sources* const only = ground_.size() < sources_.size() ? &ground_ : nullptr;
    Proposal proposal = lines_.empty() ? propose_levels(*index_, tiles_, bases_, units_, posts_in_squares_, progress_)
                                       : find_ground(*index_, tiles_, bases_, only, progress_);
    close_levels(proposal.raised);
    report_.isolated = index_->drop(std::move(proposal.isolated));
    outline_ = join_collinear(std::move(proposal.outline));
  }

  /// Step 2: lays lines on the ground.
  void place() {
    if (lines_.empty()) return;
    placed_ = place_lines(lines_, *index_, tiles_, ground_, bases_, outline_, progress_);
    index_->drop(placed_.strays);
  }

  /// Step 3: infers points where contours leave the surface flat.
  void repair_contours() {
    if (of_kind(placed_.terrain, ThemeKind::Contours, lines_).empty()) return;
    const FlatSurvey flat = survey_flat(*index_, tiles_, placed_, outline_, lines_, progress_);
    report_.flat_before = report_.flat_after = flat.triangles();
    const auto source =
        std::find_if(sources_.begin(), sources_.end(), [](const auto& s) { return s.kind == kInferred; });
    if (source == sources_.end()) return;
    SortedPoints with = points_.with(raw_points(inferred_ != nullptr ? *inferred_ : flat.inferred(),
                                                static_cast<std::size_t>(source - sources_.begin())),
                                     kDropped);
    imported_ = std::exchange(points_, std::move(with));
    index_points();
    report_.flat_after = survey_flat(*index_, tiles_, placed_, outline_, lines_, progress_).triangles();
  }

  /// Step 4: gives the terrain's lines at all levels.
  void generalise() {
    placed_.raised = raised_segments(lines_);
    placed_.ground = ground_segments(lines_);
    hierarchy_ = generalised(placed_, outline_, lines_, units_);
    set_lines();
  }

  void set_lines() {
    std::vector<Segment> segments = outline_;
    if (hierarchy_) {
      std::vector<LevelRaise> raises;
      for (const auto& [code, level] : hierarchy_->levels()) raises.push_back({code, level});
      index_->promote(std::move(raises));
      append(segments, hierarchy_->segments());
    }
    index_->set_segments(std::move(segments));
  }

  /// Step 5: proposes the levels where there are lines. Every end of the outline and of lines on the ground is in all
  /// levels.
  void propose_with_lines() {
    if (lines_.empty()) return;
    std::vector<Segment> whole = outline_;
    append(whole, placed_.features);
    std::vector<LevelRaise> ends;
    for (const Segment& s : whole) {
      ends.push_back({code_of(s.a()), levels_ - 1});
      ends.push_back({code_of(s.b()), levels_ - 1});
    }
    close_levels(ends);
    index_->promote(std::move(ends));
    close_levels(propose_levels_with_lines(*index_, tiles_, units_, posts_in_squares_, progress_).raised);
    if (hierarchy_) lead_lines_through();
  }

  /// Raises what the hierarchy of posts needs where these posts are raised.
  void close_levels(const std::vector<LevelRaise>& raised) { index_->promote(posts_in_squares_.closing(raised)); }

  /// Leads a line through those of its vertices that a level has.
  void lead_lines_through() {
    std::vector<LineHierarchy::Shortcut> passed_by;
    const std::vector<LineHierarchy::VertexLevel> on_lines = hierarchy_->levels();
    auto vertex = on_lines.begin();
    for (const CurveRange& leaf : index_->ranges()) {
      for (const RawPoint& p : index_->read(leaf)) {
        while (vertex != on_lines.end() && vertex->code < p.code) ++vertex;
        if (vertex == on_lines.end() || vertex->code != p.code || p.level == kDropped) continue;
        if (p.level > vertex->level) passed_by.push_back({p.level, position_of(p.code), position_of(p.code)});
      }
    }
    std::sort(passed_by.begin(), passed_by.end());
    restore(passed_by);
  }

  std::vector<LineHierarchy::Restored> restore(const std::vector<LineHierarchy::Shortcut>& shortcuts) {
    std::vector<LineHierarchy::Restored> restored = hierarchy_->restore(shortcuts);
    if (!restored.empty()) set_lines();
    return restored;
  }

  /// Step 6: certifies the levels.
  LeafBounds certify_levels() {
    return certify(
        *index_, whole_units_, posts_in_squares_, sea_, [&](const auto& shortcuts) { return restore(shortcuts); },
        progress_);
  }

  /// Returns the first level whose vertices are stored a second time: the finest that has few enough.
  int fine_levels() const {
    const std::uint64_t most = index_->selected_points(0) / kPointsPerCopy;
    int level = 1;
    while (level < levels_ && index_->selected_points(level) > most) ++level;
    return level;
  }

  /// Step 7: writes points and bounds, level by level.
  void write_ground(LeafBounds bounds) {
    for (std::uint32_t leaf = 0; leaf < index_->ranges().size(); ++leaf) {
      // The full surface differs from itself by nothing, wherever there is ground.
      if (levels_ > 1 && !bounds.at(leaf, 1).empty()) bounds.at(leaf, 0) = {0, 0};
    }
    const std::vector<CoveredPoint>& covered = imported().covered();
    const double steps = static_cast<double>(tiles_.size() * static_cast<std::size_t>(levels_));
    std::size_t done = 0;
    writer_.set_fine_levels(fine_levels());
    writer_.set_right_triangle_levels(posts_in_squares_.coarsest_level());
    for (int k = 0; k < levels_; ++k) {
      LevelWriter level(*index_, bounds, k, writer_);
      for (const CurveRange& tile : tiles_) {
        progress_.throw_if_cancelled();
        for (RawPoint p : index_->read(tile)) {
          if (p.level == kDropped || (k > 0 && p.level != k)) continue;
          p.source = own_source(p, covered);
          level.add(p);
          if (k == 0) report_.vertices_of_source[p.source] += 1;
        }
        progress_.report("writing", static_cast<double>(++done) / steps);
      }
      level.finish();
    }
  }

  /// Step 8: writes features with their vertices, parts, and the segments of all lines.
  void write_lines() {
    LineWriter(lines_, placed_, *index_, writer_, report_).run(index_->all_segments(), segment_features(), progress_);
  }

  /// The features of all segments. The hierarchy has the segments of the terrain's lines; others are whole at all
  /// levels.
  std::vector<SegmentFeature> segment_features() const {
    std::vector<SegmentFeature> features;
    if (hierarchy_) features = hierarchy_->features(placed_.of_features);
    std::copy_if(placed_.of_features.begin(), placed_.of_features.end(), std::back_inserter(features),
                 [&](const SegmentFeature& f) { return !lines_.terrain[f.segment.theme - std::size_t{1}]; });
    std::sort(features.begin(), features.end());
    return features;
  }

  SortedPoints& points_;
  const std::vector<SourceInfo>& sources_;
  const ThemeLines& lines_;
  const std::vector<GridPoint>* inferred_;
  const int levels_;
  const std::vector<std::array<double, 4>> bases_;
  StoreWriter& writer_;
  CallProgress progress_;
  const Sources ground_ = ground_sources(sources_);
  const bool sea_ = std::any_of(sources_.begin(), sources_.end(), is_sea);  ///< then coarse triangles are long
  std::vector<double> units_;                                               ///< tolerances in grid units
  std::vector<std::int32_t> whole_units_;
  std::optional<SortedPoints> imported_;  ///< where `points_` has become the points of the surface
  std::optional<WorkingIndex> index_;
  std::vector<CurveRange> tiles_;
  PostHierarchy posts_in_squares_;
  std::vector<Segment> outline_;
  PlacedLines placed_;
  std::optional<LineHierarchy> hierarchy_;
  PyramidReport report_;
};

}  // namespace

bool is_ground(const SourceInfo& source) {
  return source.theme.empty() ? source.kind != kInferred : source.kind == name_of(ThemeKind::Contours);
}

bool is_sea(const SourceInfo& source) {
  return source.kind == kSea;
}

PyramidReport build_pyramid(const PyramidSources& of, StoreWriter& writer, Progress& progress) {
  return PyramidBuild(of, writer, progress).run();
}

}  // namespace itin
