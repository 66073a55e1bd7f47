#include "import/vectors/line_collection.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/sort_unique.hpp>
#include <itin/triangulate.hpp>

#include "features/mesh/feature_mesh.hpp"
#include "features/part_vertices.hpp"
#include "import/source/layers/kept_features.hpp"
#include "import/source/source_order.hpp"
#include "pyramid/points_on_lines.hpp"
#include "store/codec/store_format.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

/// Memory at the peak of imports; measured, rounded up. For lines it is taken while they are simplified, with their
/// pieces as they were imported (690 where breaklines cut each other, 530 for roads); for features while they are
/// raised.
constexpr std::uint64_t kBytesPerLineVertex = 800, kBytesPerFeatureVertex = 3000;

/// The third vertex of the full surface's triangle left of an edge.
std::optional<Position> apex_of(const Store& ground, Position from, Position to) {
  const Grid& grid = ground.metadata().grid;
  Box box;
  for (const Position& p : {from, to}) box.extend(grid.position(p.x, p.y));
  box = {box.xmin - grid.resolution, box.ymin - grid.resolution, box.xmax + grid.resolution,
         box.ymax + grid.resolution};
  NoProgress quiet;
  const Tin tin = triangulate(ground, Window::box(box), Detail::tolerance(0), quiet);
  const auto at = [&](std::uint32_t v) { return Position{tin.vertices[v].x, tin.vertices[v].y}; };
  for (const Triangle& t : tin.triangles)
    for (int i = 0; i < 3; ++i)
      if (at(t[i]) == from && at(t[(i + 1) % 3]) == to) return at(t[(i + 2) % 3]);
  return std::nullopt;
}

std::uint64_t bytes_of(const FeatureRecord& record) {
  std::uint64_t bytes = sizeof record + record.id.size() + record.name.size();
  for (const AttributeValue& value : record.values) {
    const auto* text = std::get_if<std::string>(&value);
    bytes += sizeof value + (text != nullptr ? text->size() : 0);
  }
  return bytes;
}

const GridPoint* vertex_at(const RaisedPart& part, Position p) {
  const auto at = find_by_code(part.vertices, code_of(p));
  return at != part.vertices.end() ? &*at : nullptr;
}

/// Returns the numbers of the footprints in an order that knows no order of import, for where features meet, the order
/// decides.
std::vector<std::size_t> order_of_content(const std::vector<StoredFootprint>& footprints) {
  std::vector<std::pair<std::string, std::size_t>> order;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const std::vector<std::uint8_t> content = content_of(footprints[i].feature);
    order.emplace_back(std::string(content.begin(), content.end()), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> result;
  for (const auto& [content, i] : order) result.push_back(i);
  return result;
}

/// Returns ascending runs of the numbers `order[place]`.
std::vector<FeatureRun> runs_of(const std::vector<std::size_t>& places, const std::vector<std::size_t>& order) {
  std::vector<std::int64_t> numbers;
  for (const std::size_t place : places) numbers.push_back(static_cast<std::int64_t>(order[place]));
  std::sort(numbers.begin(), numbers.end());
  std::vector<FeatureRun> runs;
  for (const std::int64_t number : numbers) {
    if (!runs.empty() && runs.back().last + 1 == number)
      runs.back().last = number;
    else
      runs.push_back({number, number});
  }
  return runs;
}

}  // namespace

void LineCollection::require_room(const std::string& source) const {
  const std::uint64_t needed =
      line_vertices_ * kBytesPerLineVertex + feature_vertices_ * kBytesPerFeatureVertex + record_bytes_;
  if (needed <= memory_bytes_) return;
  throw InputError(
      fmt::format("{}: the lines and features of the store have now more than {} vertices, for which {} MB of memory "
                  "are too little; "
                  "give more than {} MB, or import them into several stores",
                  source, line_vertices_ + feature_vertices_, memory_bytes_ >> 20, needed >> 20));
}

void LineCollection::take_themes(const StoreMetadata& metadata, const Sources& left_out) {
  for (const ThemeInfo& theme : metadata.themes) {
    CollectedTheme& taken = themes_.emplace_back();
    taken.info = theme, taken.raised = theme.is_raised(), taken.gone = true;
    taken.info.wall_offset.reset();
    for (std::size_t s = 0; s < metadata.sources.size(); ++s) {
      const SourceInfo& source = metadata.sources[s];
      if (source.theme != theme.name || left_out.contains(static_cast<std::uint16_t>(s))) continue;
      taken.gone = false;
      if (source.wall_offset) taken.info.wall_offset = source.wall_offset;
    }
  }
  for (const SourceInfo& source : metadata.sources) theme_of_source_.push_back(source.theme);
  find_first_sources(metadata.sources);
}

void LineCollection::find_first_sources(const std::vector<SourceInfo>& sources) {
  const std::vector<std::uint32_t> ranks = ranks_of(sources);
  for (CollectedTheme& theme : themes_) {
    std::optional<std::size_t> first;
    for (std::size_t s = 0; s < sources.size(); ++s)
      if (sources[s].theme == theme.info.name && (!first || ranks[s] < ranks[*first])) first = s;
    theme.first_source = static_cast<std::uint16_t>(first.value_or(0));
  }
}

void LineCollection::take_segments(const Store& store) {
  store.points().segments(store.points().bounds(), stored_);
  for (std::size_t t = 1; t <= themes_.size(); ++t)
    file_of(store).segment_features(static_cast<std::uint16_t>(t), store.points().bounds(), stored_features_);
  std::erase_if(stored_features_, [](const SegmentFeature& f) { return f.segment.finest > 0; });
  sort_unique(stored_features_);
  // The lines that keep the ground about features are made again with the features.
  std::erase_if(stored_, [&](const Segment& s) {
    return s.theme == kCoverage || s.finest > 0 || s.theme > themes_.size() || themes_[s.theme - std::size_t{1}].raised;
  });
  line_vertices_ += stored_.size();
  sort_unique(stored_);
  for (const Segment& s : stored_) {
    const auto theme = static_cast<std::uint32_t>(s.theme - 1);
    if (!is_terrain(theme_of(s).kind)) continue;
    for (const std::uint64_t end : {code_of(s.a()), code_of(s.b())}) {
      std::uint32_t& of_end = ends_.try_emplace(end, theme).first->second;
      of_end = std::min(of_end, theme);
    }
  }
}

bool LineCollection::take_vertex(const GridPoint& p, std::uint16_t source, bool of_terrain) {
  const std::uint64_t code = code_of(p);
  const auto end = of_terrain ? ends_.find(code) : ends_.end();
  if (theme_of_source_[source].empty()) return false;
  // A vertex whose lines have left the ground is taken with these lines where they are taken as they were imported.
  if (of_terrain && end == ends_.end() && as_ != LinesAs::imported) return false;
  vertices_.try_emplace(code, Vertex{p.z, source});
  return true;
}

std::uint16_t LineCollection::source_of_stored(const Segment& s) const {
  for (const std::uint64_t end : {code_of(s.a()), code_of(s.b())}) {
    const auto found = vertices_.find(end);
    if (found != vertices_.end() && theme_of_source_[found->second.source] == theme_of(s).name)
      return found->second.source;
  }
  return themes_[s.theme - std::size_t{1}].first_source;
}

/// The features of a stored segment, at least one: kNoFeature where none is known.
std::vector<std::uint32_t> LineCollection::features_of(const Segment& s) const {
  std::vector<std::uint32_t> features;
  for (const SegmentFeature& f : of_segment(stored_features_, s)) features.push_back(f.feature);
  return features.empty() ? std::vector{kNoFeature} : features;
}

void LineCollection::take_set_aside(const StoreRows& rows) {
  imported_ = imported_pieces(rows, themes_.size(), stored_, [&](const Segment& s) {
    const bool of_terrain = is_terrain(theme_of(s).kind);
    const auto vertex = [&](std::int32_t x, std::int32_t y) {
      const auto found = of_terrain ? vertices_.find(morton(x, y)) : vertices_.end();
      return GridPoint{x, y, found == vertices_.end() ? 0 : found->second.z};
    };
    const auto [a, b] = std::minmax({vertex(s.ax, s.ay), vertex(s.bx, s.by)});
    return ImportedSegment{a, b, source_of_stored(s), features_of(s).front()};
  });
  // Lines that were left out beyond the ground are among these.
  line_vertices_ = std::max(line_vertices_, std::uint64_t{imported_.size()});
}

/// Adds the lines with their heights. Where lines are taken as they lie, a vertex of the terrain keeps its height, and
/// one of another line gets it anew.
void LineCollection::add_lines(const std::vector<SourceInfo>& sources, const ReplacingGround* replacing) {
  made_room_.assign(sources.size(), 0);
  if (as_ == LinesAs::imported) {
    for (const auto& [theme, s] : imported_) {
      using Pieces = std::vector<ReplacingGround::Piece>;
      const Pieces whole{{s.a, s.b}};
      const Pieces pieces = replacing != nullptr && sources[s.source].makes_room ? replacing->outside(s.a, s.b) : whole;
      made_room_[s.source] += pieces != whole ? 1 : 0;
      for (const auto& [a, b] : pieces) segments_.push_back({a, b, theme, s.feature});
    }
    return;
  }
  const auto vertex = [&](std::int32_t x, std::int32_t y) {
    const auto found = vertices_.find(morton(x, y));
    return GridPoint{x, y, found == vertices_.end() ? 0 : found->second.z};
  };
  for (const Segment& s : stored_)
    for (const std::uint32_t feature : features_of(s))
      segments_.push_back({vertex(s.ax, s.ay), vertex(s.bx, s.by), static_cast<std::uint32_t>(s.theme - 1), feature});
}

std::uint64_t LineCollection::take_features(const Store& store, const Sources& left_out) {
  std::uint64_t count = 0;
  for (std::uint32_t t = 0; t < store.metadata().themes.size(); ++t) {
    const auto number = static_cast<std::uint16_t>(t + 1);
    ThemeFeatures features = stored_features(store, number);
    themes_[t].features.fields = std::move(features.fields);
    auto record = features.records.begin();
    if (themes_[t].raised) {
      for (StoredFootprint& footprint : stored_footprints(store, number)) {
        std::optional<FeatureRecord> own;
        if (record != features.records.end()) own = std::move(*record++);
        if (left_out.contains(footprint.source))
          ++count;
        else
          add_footprint(t, std::move(footprint), std::move(own));
      }
      continue;
    }
    for (std::size_t s = 0; s < store.metadata().sources.size(); ++s) {
      const SourceInfo& source = store.metadata().sources[s];
      if (source.theme != themes_[t].info.name) continue;
      for (std::uint64_t i = 0; i < source.features && record != features.records.end(); ++i)
        add_feature(t, static_cast<std::uint16_t>(s), std::move(*record++));
    }
  }
  return count;
}

namespace {

/// Returns the numbers of things that are at `places` now, by the places that they had before.
std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& places) {
  std::vector<std::uint32_t> numbers(places.size());
  for (std::uint32_t n = 0; n < places.size(); ++n) numbers[places[n]] = n;
  return numbers;
}

template <class T>
void put_in(const std::vector<std::uint32_t>& order, std::vector<T>& items) {
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (const std::uint32_t i : order) sorted.push_back(std::move(items[i]));
  items = std::move(sorted);
}

/// Puts a theme's features in the order of their sources, whose new numbers they get. Returns their new numbers by the
/// old ones.
std::vector<std::uint32_t> renumber_features(CollectedTheme& theme, const std::vector<std::uint16_t>& numbers) {
  std::vector<std::uint16_t>& source = theme.source_of_feature;
  for (std::uint16_t& s : source) s = numbers[s];
  std::vector<std::uint32_t> order(source.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return source[a] < source[b]; });
  std::vector<FeatureRecord>& records = theme.features.records;
  records.resize(order.size());
  put_in(order, records);
  put_in(order, source);
  if (theme.raised) {
    put_in(order, theme.footprints);
    for (std::size_t i = 0; i < source.size(); ++i) theme.footprints[i].source = source[i];
    while (!records.empty() && records.back() == FeatureRecord{}) records.pop_back();
  }
  return inverse(order);
}

/// Puts a theme's fields in the order of its sources, as if these had come in that order, and drops those that none
/// has.
void rearrange_fields(CollectedTheme& theme, const std::vector<SourceInfo>& sources) {
  std::vector<AttributeField> fields;
  std::vector<std::vector<std::size_t>> before(sources.size()), now(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (sources[s].theme != theme.info.name) continue;
    before[s] = places_among(theme.features.fields, sources[s].fields, sources[s].path);
    now[s] = places_among(fields, sources[s].fields, sources[s].path);
  }
  for (std::size_t i = 0; i < theme.features.records.size(); ++i) {
    FeatureRecord& record = theme.features.records[i];
    if (record == FeatureRecord{}) continue;
    const std::uint16_t s = theme.source_of_feature[i];
    record.values.resize(theme.features.fields.size());
    std::vector<AttributeValue> of_source;
    for (const std::size_t place : before[s]) of_source.push_back(std::move(record.values[place]));
    record.values = std::move(of_source);
    record = arranged(std::move(record), now[s]);
  }
  theme.features.fields = std::move(fields);
}

}  // namespace

void LineCollection::renumber(const std::vector<std::uint16_t>& numbers, std::vector<SourceInfo>& sources) {
  for (SourceInfo& source : sources) source.features = 0;
  std::vector<std::vector<std::uint32_t>> number_of;  // new numbers of features, by theme and old number
  for (CollectedTheme& theme : themes_) {
    number_of.push_back(renumber_features(theme, numbers));
    rearrange_fields(theme, sources);
    for (const std::uint16_t s : theme.source_of_feature) ++sources[s].features;
  }
  const auto give_number = [&](std::size_t theme, std::uint32_t& feature) {
    if (feature != kNoFeature) feature = number_of[theme][feature];
  };
  for (ImportedPiece& piece : imported_) {
    piece.segment.source = numbers[piece.segment.source];
    give_number(piece.theme, piece.segment.feature);
  }
  for (SegmentFeature& f : stored_features_) give_number(f.segment.theme - std::size_t{1}, f.feature);
  std::sort(stored_features_.begin(), stored_features_.end());
  for (auto& [code, vertex] : vertices_) vertex.source = numbers[vertex.source];
  theme_of_source_.clear();
}

std::uint32_t LineCollection::theme(const std::string& name, ThemeKind kind, bool raised) {
  const auto found = std::find_if(themes_.begin(), themes_.end(),
                                  [&](const CollectedTheme& t) { return t.info.name == name && !t.gone; });
  if (found == themes_.end()) {
    if (themes_.size() == format::kMaxThemes)
      throw InputError(fmt::format("a store holds at most {} themes", format::kMaxThemes));
    themes_.push_back({.info = {name, kind, 0, 0, 0}, .raised = raised});
    return static_cast<std::uint32_t>(themes_.size() - 1);
  }
  if (found->info.kind != kind)
    throw InputError(fmt::format("theme '{}': holds {} already, not {}; choose another name with `theme`", name,
                                 name_of(found->info.kind), name_of(kind)),
                     "theme");
  if (found->raised != raised)
    throw InputError(fmt::format("theme '{}': holds {}; choose another name with `theme`", name,
                                 raised ? "outlines on the ground, not features with heights"
                                        : "features with heights, not outlines on the ground"),
                     "theme");
  return static_cast<std::uint32_t>(found - themes_.begin());
}

void LineCollection::offset_walls(std::uint32_t theme, double metres, const Grid& grid) {
  require_wall_offset(metres, grid);
  ThemeInfo& info = themes_[theme].info;
  const double before = info.wall_offset.value_or(default_wall_offset(grid));
  if (metres != before && !themes_[theme].footprints.empty())
    throw InputError(fmt::format("theme '{}': has a `wall_offset` of {} m already, not {} m; leave it out, or choose "
                                 "another name with `theme`",
                                 info.name, before, metres),
                     "wall_offset");
  info.wall_offset = metres;
}

void LineCollection::add(std::uint32_t theme, std::uint16_t source, std::uint32_t feature,
                         std::span<const GridPoint> line) {
  line_vertices_ += line.size();
  const bool of_terrain = is_terrain(themes_[theme].info.kind);
  const auto vertex = [&](const GridPoint& p) { return GridPoint{p.x, p.y, of_terrain ? p.z : 0}; };
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto [a, b] = std::minmax({vertex(line[i - 1]), vertex(line[i])});
    // An upright piece is passed over: its ends are those of its neighbours.
    if (a.x != b.x || a.y != b.y) imported_.push_back({theme, {a, b, source, feature}});
  }
}

std::uint32_t LineCollection::add_feature(std::uint32_t theme, std::uint16_t source, FeatureRecord record) {
  record_bytes_ += bytes_of(record);
  themes_[theme].features.records.push_back(std::move(record));
  themes_[theme].source_of_feature.push_back(source);
  return static_cast<std::uint32_t>(themes_[theme].source_of_feature.size() - 1);
}

void LineCollection::add_footprint(std::uint32_t theme, StoredFootprint footprint,
                                   std::optional<FeatureRecord> record) {
  CollectedTheme& own = themes_[theme];
  if (record) {
    // Records have the numbers of their footprints.
    record_bytes_ += bytes_of(*record);
    own.features.records.resize(own.footprints.size());
    own.features.records.push_back(std::move(*record));
  }
  feature_vertices_ += vertex_count(footprint.feature);
  own.source_of_feature.push_back(footprint.source);
  own.footprints.push_back(std::move(footprint));
}

bool LineCollection::is_raised() const {
  return std::any_of(themes_.begin(), themes_.end(), [](const CollectedTheme& t) { return !t.footprints.empty(); });
}

void LineCollection::raise(const Store& ground, RaisedFeaturesReport& report, Progress& progress) {
  report = {};
  for (std::uint32_t t = 0; t < themes_.size(); ++t) {
    CollectedTheme& theme = themes_[t];
    if (theme.footprints.empty()) continue;
    const double wall_offset = theme.info.wall_offset.value_or(default_wall_offset(ground.metadata().grid));
    const std::vector<std::size_t> order = order_of_content(theme.footprints);
    std::vector<StoredFootprint> footprints;
    for (const std::size_t i : order) footprints.push_back(theme.footprints[i]);
    RaisedFeatureTheme raised = raise_theme(ground, footprints, wall_offset, memory_bytes_, progress);
    theme.info.features = raised.built;
    theme.info.left_out = runs_of(raised.left_out, order);
    report.features += raised.built;
    report.refused += raised.refused;
    report.themes.push_back({theme.info.name, raised.built, std::move(raised.reports)});
    for (RaisedPart& part : raised.parts) parts_.push_back({t, std::move(part)});
    for (const auto& [a, b] : raised.ground.pieces) keep({{a.x, a.y, 0}, {b.x, b.y, 0}, t});
    theme.changed = std::move(raised.ground);
  }
}

/// Adds an edge that keeps the ground about features.
void LineCollection::keep(const OwnedSegment& ground_line) {
  segments_.push_back(ground_line);
  for (const GridPoint& p : {ground_line.a, ground_line.b}) ground_ends_.push_back({ground_line.owner, code_of(p)});
}

/// Adds the lines of parts to make_planar()'s segments, under the numbers that follow the themes'.
void LineCollection::place_parts(ThemeLines& result) {
  std::stable_sort(parts_.begin(), parts_.end(), [](const OwnPart& a, const OwnPart& b) { return a.theme < b.theme; });
  std::vector<std::uint32_t> by_rank(themes_.size());
  std::iota(by_rank.begin(), by_rank.end(), 0U);
  std::sort(by_rank.begin(), by_rank.end(),
            [&](std::uint32_t a, std::uint32_t b) { return comes_before(themes_[a].info, themes_[b].info); });
  for (OwnPart& own : parts_) {
    const auto owner = static_cast<std::uint32_t>(themes_.size() + result.parts.size());
    if (owner >= format::kMaxThemes)
      throw InputError(fmt::format("a store holds at most {} themes and parts of themes", format::kMaxThemes));
    for (const RaisedSegment& s : own.part.segments) segments_.push_back({s.a, s.b, owner, s.cluster});
    PlacedPart& placed = result.parts.emplace_back();
    placed.part = {static_cast<std::uint16_t>(own.theme + 1), own.part.coarsest};
    placed.rank = static_cast<int>(std::find(by_rank.begin(), by_rank.end(), own.theme) - by_rank.begin());
    placed.source = own.part.source;
    placed.masks = std::move(own.part.masks);
    placed.mask_clusters = own.part.mask_clusters;
    placed.reaches = std::move(own.part.reaches);
  }
}

std::uint16_t LineCollection::source_of(const GridPoint& p, std::uint32_t owner) const {
  const auto found = vertices_.find(code_of(p));
  if (found != vertices_.end()) return found->second.source;
  return owner < themes_.size() ? themes_[owner].first_source : parts_[owner - themes_.size()].part.source;
}

/// Keeps a line of the ground. Where it lies under a draped feature, it becomes a line of that feature's top. `masks`
/// are the masks of the parts.
void LineCollection::keep_or_raise(const OwnedSegment& ground_line, const std::vector<MaskIndex>& masks) {
  const Position a{ground_line.a.x, ground_line.a.y}, b{ground_line.b.x, ground_line.b.y};
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].theme != ground_line.owner) continue;
    const std::optional<std::uint32_t> mask = masks[p].about_middle(a, b);
    if (!mask) continue;
    RaisedPart& part = parts_[p].part;
    const GridPoint *top_a = vertex_at(part, a), *top_b = vertex_at(part, b);
    if (top_a == nullptr || top_b == nullptr) continue;
    const std::uint32_t cluster = part.mask_clusters[*mask];
    part.segments.push_back({*top_a, *top_b, false, cluster});
    segments_.push_back({*top_a, *top_b, static_cast<std::uint32_t>(themes_.size() + p), cluster});
    return;
  }
  keep(ground_line);
}

/// Makes all segments planar, with the lines that keep the ground about features.
void LineCollection::make_lines(ThemeLines& result, const Store* ground, const Progress& progress) {
  GroundBorder border(themes_.size());
  for (std::uint32_t t = 0; t < themes_.size(); ++t) border.add(t, themes_[t].changed);
  std::vector<MaskIndex> masks;
  for (const PlacedPart& part : result.parts) masks.emplace_back(part.masks);
  for (const OwnedSegment& s : border.seams()) keep_or_raise(s, masks);
  GroundBorder::Owners owners;
  owners.terrain = result.terrain;
  for (std::uint32_t t = 0; t < themes_.size(); ++t) owners.theme.push_back(t);
  for (const PlacedPart& part : result.parts) owners.theme.push_back(part.part.theme - 1u);
  const auto apex = [&](Position from, Position to) { return apex_of(*ground, from, to); };
  for (;;) {
    progress.throw_if_cancelled();
    result.lines = make_planar(segments_, &progress);
    GroundBorder::Fit fit = border.fit(result.lines, owners, apex);
    result.borders = std::move(fit.placed);
    if (fit.lines.empty()) break;
    for (const OwnedSegment& s : fit.lines) keep_or_raise(s, masks);
  }
  segments_.clear();
  sort_unique(ground_ends_);
  result.ground_ends = std::move(ground_ends_);
}

bool LineCollection::changes_terrain(const ThemeLines& lines) const {
  const std::vector<std::uint32_t> vertices = lines.terrain_vertices();
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](std::uint32_t v) { return !ends_.contains(code_of(lines.lines.vertices[v])); });
}

/// Puts the themes of the terrain before the others, then orders by name.
void LineCollection::put_in_order(ThemeLines& result) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t t = 0; t < themes_.size(); ++t)
    if (!themes_[t].gone) order.push_back(t);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const ThemeInfo &p = themes_[a].info, &q = themes_[b].info;
    return std::pair(!is_terrain(p.kind), p.name) < std::pair(!is_terrain(q.kind), q.name);
  });
  std::vector<std::uint32_t> number(themes_.size());
  std::vector<CollectedTheme> themes;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    number[order[i]] = i;
    themes.push_back(std::move(themes_[order[i]]));
    result.terrain.push_back(is_terrain(themes.back().info.kind));
    result.kinds.push_back(themes.back().info.kind);
    result.raised.push_back(themes.back().raised);
  }
  for (ThemeVertex& end : ground_ends_) end.theme = number[end.theme];
  for (OwnedSegment& s : segments_) s.owner = number[s.owner];
  for (OwnPart& own : parts_) own.theme = number[own.theme];
  for (ImportedPiece& i : imported_) i.theme = number[i.theme];
  std::sort(imported_.begin(), imported_.end());
  themes_ = std::move(themes);
}

/// A vertex that several sources bring along belongs to the one that comes first.
void LineCollection::find_vertices(const std::vector<SourceInfo>& sources) {
  const std::vector<std::uint32_t> ranks = ranks_of(sources);
  vertices_.clear();
  for (const auto& [theme, s] : imported_) {
    for (const GridPoint& p : {s.a, s.b}) {
      const auto [at, fresh] = vertices_.try_emplace(code_of(p), Vertex{p.z, s.source});
      if (!fresh && ranks[s.source] < ranks[at->second.source]) at->second.source = s.source;
    }
  }
}

ThemeLines LineCollection::finish(const std::vector<SourceInfo>& sources, const Store* ground,
                                  const ReplacingGround* replacing, const SortedPoints* points, Progress& progress) {
  sort_unique(imported_);
  add_lines(sources, replacing);
  ThemeLines result;
  put_in_order(result);
  find_first_sources(sources);
  if (as_ == LinesAs::imported) find_vertices(sources);
  place_parts(result);
  if (points != nullptr) lead_through_points(*points, result.terrain, segments_, progress);
  make_lines(result, ground, progress);
  if (points != nullptr) lead_through_points(*points, result.terrain, result.lines, progress);
  std::vector<std::uint32_t> owner(result.lines.vertices.size(), std::numeric_limits<std::uint32_t>::max());
  std::vector<std::vector<Position>> ends(parts_.size());
  for (const PlanarEdge& e : result.lines.edges) {
    for (const std::uint32_t v : {e.from, e.to}) {
      owner[v] = std::min(owner[v], e.owner);
      const GridPoint& p = result.lines.vertices[v];
      if (result.is_raised(e)) ends[e.owner - themes_.size()].push_back({p.x, p.y});
    }
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) result.parts[p].vertices = part_vertices(parts_[p].part, ends[p]);
  for (std::size_t v = 0; v < owner.size(); ++v)
    result.sources.push_back(source_of(result.lines.vertices[v], owner[v]));
  return result;
}

}  // namespace itin
