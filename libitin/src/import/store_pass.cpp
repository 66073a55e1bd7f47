#include "import/store_pass.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/precondition.hpp>

#include "import/empty_import.hpp"
#include "import/source/source_context.hpp"
#include "import/source/source_order.hpp"
#include "import/source/true_scale.hpp"
#include "import/vectors/line_layer.hpp"
#include "pyramid/kept_ground.hpp"
#include "store/codec/store_format.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

/// Returns a source as the store names it: without the folder, which says nothing of the data, and nothing to whoever
/// gets the store.
SourceInfo recorded(SourceInfo source, const ImportOptions& options) {
  const std::filesystem::path path(source.path);
  source.path = (path.has_filename() ? path : path.parent_path()).filename().string();
  if (!options.source_note.empty() && !is_sea(source)) source.note = options.source_note;
  return source;
}

bool replaces(const TerrainSource& source, const ImportOptions& options) {
  return options.replace && !is_sea(source.info());
}

SourceInfo inferred_source() {
  SourceInfo source;
  source.path = "inferred from contours";
  source.kind = kInferred;
  source.imported = utc_now();
  return source;
}

/// Requires true lengths where the points lie: files may not say how far they reach, or say it wrongly.
void require_true_scale(const ImportPlan& plan, const std::string& path, const GridBox& bounds) {
  if (!bounds.empty()) plan.scale->require(path, plan.grid.box(bounds));
}

std::string directory_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// Returns the themes with counts summed over their parts.
std::vector<ThemeInfo> counted_themes(const LineCollection& collection, const ThemeLines& lines,
                                      const PyramidReport& pyramid) {
  std::vector<ThemeInfo> themes;
  for (std::size_t t = 0; t < collection.themes().size(); ++t) {
    themes.push_back(collection.themes()[t].info);
    themes[t].segments = pyramid.segments[t];
    themes[t].vertices = pyramid.line_vertices[t];
  }
  for (std::size_t p = 0; p < lines.parts.size(); ++p) {
    ThemeInfo& theme = themes[lines.parts[p].part.theme - std::size_t{1}];
    theme.segments += pyramid.segments[themes.size() + p];
    theme.vertices += pyramid.line_vertices[themes.size() + p];
  }
  return themes;
}

/// The shares of an import's time that steps take, measured with rasters of millions of posts. Each is a share of what
/// is left: collecting of all of it, raising (with features) of the rest, then replacing (where lines make room), then
/// sorting, and then leading lines through points.
constexpr double kCollecting = 0.05, kRaising = 0.6, kReplacing = 0.2, kSorting = 0.03, kLeading = 0.01;

}  // namespace

SetAsideCounts counts_of(const Store* store) {
  return store == nullptr ? SetAsideCounts{} : set_aside_list(file_of(*store).rows()).counts;
}

StorePass::StorePass(const Target& target, const PassSources& of, const ImportOptions& options, ImportReport& report)
    : target_(target),
      base_(of.base),
      ground_(of.ground),
      keeps_ground_(of.keeps_ground),
      additions_(of.additions),
      options_(options),
      report_(report),
      repair_(will_repair(options, of.base)),
      sources_(imported_sources(of.base)),
      replacing_(replacing_lines()),
      points_(directory_of(target.interim), options.memory_bytes / 2, replacing_),
      collection_(of.ground == nullptr ? LinesAs::imported : LinesAs::laid, options.memory_bytes) {
  require_numbers();
}

bool StorePass::run(RaisedFeaturesReport& raised, Progress& progress) {
  CallProgress call(progress);
  collect(call.step(kCollecting));
  number_sources();
  if (ground_ != nullptr) collection_.raise(*ground_, raised, call.step(kRaising));
  if (!keeps_ground_) return make_ground(call);
  put_on_ground(call);
  return true;
}

/// Makes the ground of all points, with all lines and features. Returns what run() does.
bool StorePass::make_ground(CallProgress& call) {
  const std::optional<ReplacingGround> replacing =
      points_.replacing_ground(sources_, additions_.plan.grid, call.step(replacing_.empty() ? 0 : kReplacing));
  SortedPoints points = sorted_points(call.step(kSorting));
  const ThemeLines lines =
      collection_.finish(sources_, ground_, replacing ? &*replacing : nullptr, &points, call.step(kLeading));
  add_line_vertices(lines, points);
  const bool done =
      target_.last || !collection_.is_raised() || (ground_ != nullptr && !collection_.changes_terrain(lines));
  std::optional<StoreWriter> interim;
  if (!done) interim.emplace(target_.interim, additions_.plan.crs_wkt, additions_.plan.grid, target_.tolerances);
  StoreWriter& writer = done ? target_.writer : *interim;
  finish(build(lines, points, done ? target_.tolerances : std::vector<double>{0.0}, writer, call.step(1)), lines,
         writer);
  return done;
}

/// Puts the features on the ground that is there.
void StorePass::put_on_ground(CallProgress& call) {
  const ThemeLines lines = collection_.finish(sources_, ground_, nullptr, nullptr, call.step(kLeading));
  finish(keep_ground(*ground_, sources_, lines, target_.writer, call.step(1)), lines, target_.writer);
}

void StorePass::finish(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer) {
  set_aside(pyramid, lines, writer);
  count(pyramid, lines);
  commit(pyramid, lines, writer);
}

/// The sources whose ground lines make room for, if any lines do. Lines that lie on a ground have done so already.
Sources StorePass::replacing_lines() const {
  const ImportPlan& plan = additions_.plan;
  const bool make_room =
      std::any_of(sources_.begin(), sources_.end(), [](const SourceInfo& s) { return s.makes_room; }) ||
      std::any_of(plan.lines.begin(), plan.lines.end(), [](const auto& layer) { return layer->info().makes_room; });
  Sources replacing;
  if (ground_ != nullptr || !make_room) return replacing;
  for (std::size_t s = 0; s < sources_.size(); ++s)
    if (sources_[s].replaces) replacing.insert(static_cast<std::uint16_t>(s));
  for (std::size_t i = 0; i < plan.sources.size(); ++i)
    if (replaces(*plan.sources[i], options_)) replacing.insert(static_cast<std::uint16_t>(sources_.size() + i));
  return replacing;
}

void StorePass::require_numbers() const {
  const std::size_t added =
      additions_.plan.sources.size() + additions_.plan.lines.size() + additions_.footprints.size();
  // One more source may stand for inferred points.
  if (sources_.size() + added >= format::kMaxSources)
    throw InputError("a store holds at most 32,766 sources; merge some of them first");
}

void StorePass::collect(Progress& progress) {
  CallProgress call(progress);
  auto left = static_cast<double>(additions_.plan.sources.size() + additions_.plan.lines.size()) + 1;
  if (base_ != nullptr) {
    collection_.take_themes(base_->metadata(), additions_.removed);
    if (!keeps_ground_) stored_ = add_stored_ground(*base_, points_, collection_, call.step(1 / left));
    report_.removed += collection_.take_features(*base_, additions_.removed);
  }
  const auto add_info = [&](const SourceInfo& info) -> SourceInfo& {
    added_.push_back(next_number());
    return sources_.emplace_back(recorded(info, options_));
  };
  for (const auto& source : additions_.plan.sources) {
    add_source(*source, call.step(1 / --left));
    add_info(source->info()).replaces = replaces(*source, options_);
  }
  for (const auto& layer : additions_.plan.lines) {
    add_lines(*layer, call.step(1 / --left));
    add_info(layer->info()).fields = layer->fields().fields();
  }
  for (FootprintFile& file : additions_.footprints) {
    add_footprints(file);
    SourceInfo& info = add_info(file.info);
    info.fields = file.footprints.fields, info.wall_offset = options_.wall_offset;
  }
  if (!additions_.empty()) require_points(report_, options_, base_ != nullptr);
}

/// Gives all sources, and the features that they bring, the numbers that they have in the new store.
void StorePass::number_sources() {
  std::vector<bool> left_out(sources_.size(), false);
  for (const std::uint16_t s : additions_.removed) left_out[s] = true;
  const std::vector<std::uint16_t> numbers = numbers_of(sources_, left_out);
  for (std::size_t s = 0; s < sources_.size(); ++s)
    ITIN_PRECONDITION(!keeps_ground_ || !sources_[s].theme.empty() || numbers[s] == s);
  std::vector<SourceInfo> numbered(sources_.size() - additions_.removed.size());
  for (std::size_t s = 0; s < sources_.size(); ++s)
    if (!left_out[s]) numbered[numbers[s]] = std::move(sources_[s]);
  sources_ = std::move(numbered);
  for (std::uint16_t& s : added_) s = numbers[s];
  points_.renumber(numbers);
  collection_.renumber(numbers, sources_);
  if (repair_) sources_.push_back(inferred_source());
}

bool StorePass::is_added(std::size_t source) const {
  return std::find(added_.begin(), added_.end(), source) != added_.end();
}

void StorePass::add_source(TerrainSource& source, Progress& progress) {
  std::vector<RawPoint> raw;
  const ReadCounts counts = source.read(
      [&](std::span<const GridPoint> points) {
        raw.clear();
        for (const GridPoint& p : points) raw.push_back({code_of(p), p.z, next_number(), 0});
        points_.add(raw);
      },
      progress);
  require_true_scale(additions_.plan, source.info().path, counts.bounds);
  report_.read += counts.read;
  report_.voids += counts.voids;
  report_.filtered += counts.filtered;
  report_.warnings.insert(report_.warnings.end(), counts.warnings.begin(), counts.warnings.end());
}

void StorePass::add_lines(LineLayer& layer, Progress& progress) {
  const std::uint32_t theme = collection_.theme(options_.theme, *options_.kind, false);
  const std::vector<std::size_t> places =
      places_among(collection_.fields(theme), layer.fields().fields(), layer.path());
  std::uint32_t feature = kNoFeature;
  const LineLayer::Sink sink{[&](std::span<const GridPoint> line) {
                               collection_.add(theme, next_number(), feature, line);
                               collection_.require_room(layer.path());
                             },
                             [&](FeatureRecord record) {
                               feature =
                                   collection_.add_feature(theme, next_number(), arranged(std::move(record), places));
                             }};
  const ReadCounts counts =
      layer.read({additions_.plan.grid, additions_.plan.crs_wkt, &additions_.plan.scale->meter()}, sink, progress);
  require_true_scale(additions_.plan, layer.path(), counts.bounds);
  collection_.count_features(theme, layer.features());
  report_.read += counts.read;
  report_.read_features += layer.features();
  report_.voids += counts.voids;
  report_.filtered += counts.filtered;
  report_.features += layer.features();
  report_.warnings.insert(report_.warnings.end(), counts.warnings.begin(), counts.warnings.end());
}

void StorePass::add_footprints(FootprintFile& file) {
  const std::uint32_t theme = collection_.theme(options_.theme, *options_.kind, true);
  if (options_.wall_offset) collection_.offset_walls(theme, *options_.wall_offset, additions_.plan.grid);
  report_.read_features += file.cells > 0 ? 0 : file.footprints.features.size();
  report_.read += file.vertices + file.cells;
  report_.voids += file.voids;
  report_.cells += file.cells;
  report_.low_cells += file.low_cells;
  if (file.cells > 0) std::tie(report_.height_error_low, report_.height_error_high) = height_error_of(options_);
  report_.filtered += file.footprints.filtered;
  FootprintSource& source = file.footprints;
  const std::vector<std::size_t> places = places_among(collection_.fields(theme), source.fields, file.info.path);
  for (std::size_t i = 0; i < source.features.size(); ++i) {
    std::optional<FeatureRecord> record;
    if (!source.records.empty()) record = arranged(std::move(source.records[i]), places);
    collection_.add_footprint(theme, {std::move(source.features[i]), next_number()}, std::move(record));
  }
  collection_.require_room(file.info.path);
}

SortedPoints StorePass::sorted_points(Progress& progress) {
  std::uint64_t duplicates = 0;
  SortedPoints points = points_.finish(sources_, progress, &duplicates);
  report_.duplicates += duplicates;
  return points;
}

/// Adds the vertices of the terrain's lines, which are points of the full surface.
void StorePass::add_line_vertices(const ThemeLines& lines, SortedPoints& points) const {
  std::vector<RawPoint> vertices;
  for (const std::uint32_t v : lines.terrain_vertices()) {
    const GridPoint& p = lines.lines.vertices[v];
    vertices.push_back({code_of(p), p.z, lines.sources[v], 0});
  }
  std::vector<bool> of_lines;
  for (const SourceInfo& source : sources_) of_lines.push_back(!source.theme.empty());
  const std::vector<RawPoint> without_point = points.cover(vertices, of_lines);
  if (!without_point.empty()) points = points.with(without_point, kDropped);
}

PyramidReport StorePass::build(const ThemeLines& lines, SortedPoints& points, const std::vector<double>& tolerances,
                               StoreWriter& writer, Progress& progress) {
  // The ground that features stand on stays as it is.
  const bool keep = ground_ != nullptr && collection_.is_raised();
  return build_pyramid({points, sources_, additions_.plan.grid, tolerances, lines, keep ? &stored_.inferred : nullptr},
                       writer, progress);
}

void StorePass::set_aside(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer) const {
  const std::vector<SetAsideLines> of_themes =
      set_aside_of(collection_.imported(), pyramid.placed, pyramid.of_features, lines);
  for (std::size_t t = 0; t < of_themes.size(); ++t) writer.set_aside(static_cast<std::uint16_t>(t + 1), of_themes[t]);
  const SetAsideCounts before = counts_of(ground_);
  writer.count_set_aside({pyramid.replaced, pyramid.isolated, ground_ != nullptr ? before.segments : pyramid.left_out,
                          ground_ != nullptr ? before.crossings : lines.lines.crossings});
}

/// Whether the import adds terrain that replaces, or lines that make room.
bool StorePass::changes_made_room() const {
  const ImportPlan& plan = additions_.plan;
  return std::any_of(plan.sources.begin(), plan.sources.end(), [&](const auto& s) { return replaces(*s, options_); }) ||
         std::any_of(plan.lines.begin(), plan.lines.end(), [](const auto& layer) { return layer->info().makes_room; });
}

/// Reports lines that made room: whoever imports lines learns that they are not in the surface.
void StorePass::count_made_room() {
  const std::vector<std::uint64_t>& made_room = collection_.made_room();
  report_.made_room = std::accumulate(made_room.begin(), made_room.end(), std::uint64_t{0});
  for (std::size_t i = 0; i < additions_.plan.lines.size(); ++i) {
    const std::uint16_t source = added_[additions_.plan.sources.size() + i];
    const std::vector<ImportedPiece>& imported = collection_.imported();
    const auto pieces = std::count_if(imported.begin(), imported.end(),
                                      [&](const ImportedPiece& p) { return p.segment.source == source; });
    if (made_room[source] > 0)
      report_.warnings.push_back(
          fmt::format("{}: {} of {} pieces of lines make room, wholly or in part, for ground that was imported with "
                      "`replace`; lines imported with `stay` do not",
                      additions_.plan.lines[i]->path(), made_room[source], pieces));
  }
}

void StorePass::count(const PyramidReport& pyramid, const ThemeLines& lines) {
  if (changes_made_room()) count_made_room();
  if (ground_ != nullptr) report_.crossings = std::max(report_.crossings, lines.lines.crossings);
  report_.flat_before = pyramid.flat_before;
  report_.flat_after = pyramid.flat_after;
  if (repair_) report_.inferred = pyramid.vertices_of_source.back();
  report_.vertices = report_.sea = 0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    sources_[s].vertices = pyramid.vertices_of_source[s];
    report_.vertices += sources_[s].vertices;
    if (!is_sea(sources_[s])) continue;
    report_.sea += sources_[s].vertices;
    if (sources_[s].vertices == 0 && is_added(s))
      report_.warnings.push_back(fmt::format("`sea_level` filled nothing: there is ground all over {}",
                                             options_.sea_area.empty()
                                                 ? "the box about the sources; give `sea_area` for "
                                                   "sea beyond them"
                                                 : "`sea_area`, or it lies beside all posts; it is in the "
                                                   "store's CRS"));
  }
  require_ground(report_, options_);
}

void StorePass::commit(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer) {
  std::vector<ThemeInfo> themes = counted_themes(collection_, lines, pyramid);
  const std::vector<CollectedTheme>& collected = collection_.themes();
  for (std::size_t t = 0; t < themes.size(); ++t)
    themes[t].footprint_blocks = writer.add_footprints(static_cast<std::uint16_t>(t + 1), collected[t].footprints);
  for (std::size_t t = 0; t < themes.size(); ++t) {
    themes[t].fields = collected[t].features.fields;
    themes[t].feature_blocks = writer.add_features(static_cast<std::uint16_t>(t + 1), collected[t].features.records);
  }
  std::vector<ThemePart> parts;
  for (const PlacedPart& part : lines.parts) parts.push_back(part.part);
  writer.commit(std::move(sources_), std::move(themes), std::move(parts));
}

}  // namespace itin
