#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/unfinished.hpp>

#include "base/stoppable.hpp"
#include "import/empty_import.hpp"
#include "import/footprints/footprint_file.hpp"
#include "import/source/source_context.hpp"
#include "import/source/source_order.hpp"
#include "import/source/terrain_source.hpp"
#include "import/source/true_scale.hpp"
#include "import/standing_warnings.hpp"
#include "import/stored_sources.hpp"
#include "import/vectors/line_collection.hpp"
#include "import/vectors/line_layer.hpp"
#include "pyramid/pyramid.hpp"
#include "pyramid/sorted_points.hpp"
#include "store/set_aside.hpp"
#include "store/store_file.hpp"
#include "store/store_format.hpp"
#include "store/store_writer.hpp"

namespace itin {

namespace {

const std::vector<double> kDefaultTolerances{0.5, 1, 2, 4, 8, 16, 32};

/// Level 0 first. An existing store's levels stay as they are.
std::vector<double> tolerances_of(const ImportOptions& options, const Store* existing) {
  if (existing != nullptr) {
    std::vector<double> stored;
    for (const LevelInfo& level : existing->metadata().levels) stored.push_back(level.tolerance);
    if (!options.tolerances.empty() &&
        !std::equal(options.tolerances.begin(), options.tolerances.end(), stored.begin() + 1, stored.end())) {
      throw InputError("`tolerances`: " + existing->path() +
                       " has other levels already; leave `tolerances` out to add to it");
    }
    return stored;
  }
  std::vector<double> tolerances{0.0};
  if (options.tolerances.empty()) {
    std::copy_if(kDefaultTolerances.begin(), kDefaultTolerances.end(), std::back_inserter(tolerances),
                 [&](double t) { return t >= options.resolution; });
    return tolerances;
  }
  for (const double t : options.tolerances) {
    if (!std::isfinite(t) || t <= tolerances.back())
      throw InputError("`tolerances`: tolerances must be positive and ascending");
    if (t < options.resolution)
      throw InputError("`tolerances`: a tolerance below the resolution means nothing; raise it or lower `resolution`");
    tolerances.push_back(t);
  }
  return tolerances;
}

void check_resolution(const ImportOptions& options, const Store* existing) {
  if (!std::isfinite(options.resolution) || options.resolution <= 0)
    throw InputError("`resolution`: must be positive, in metres");
  if (existing != nullptr && options.resolution != ImportOptions{}.resolution &&
      options.resolution != existing->metadata().grid.resolution) {
    throw InputError("`resolution`: " + existing->path() +
                     " has another one already; leave it out to add to the store");
  }
}

bool has_contours(const Store& store) {
  const std::vector<ThemeInfo>& themes = store.metadata().themes;
  return std::any_of(themes.begin(), themes.end(), [](const auto& t) { return t.kind == ThemeKind::Contours; });
}

/// Whether contours are repaired after an import: unless any import of them said otherwise.
bool will_repair(const ImportOptions& options, const Store* base) {
  if (options.kind != ThemeKind::Contours) return repairs(base);
  return options.repair && (base == nullptr || !has_contours(*base) || repairs(base));
}

/// As the store names it: without the folder, which says nothing of the data, nor anything to whoever gets the store.
SourceInfo recorded(SourceInfo source) {
  const std::filesystem::path path(source.path);
  source.path = (path.has_filename() ? path : path.parent_path()).filename().string();
  return source;
}

SourceInfo inferred_source() {
  SourceInfo source;
  source.path = "inferred from contours";
  source.kind = kInferred;
  source.imported = utc_now();
  return source;
}

/// Files may not say how far they reach, or say it wrongly.
void require_true_scale(const ImportPlan& plan, const std::string& path, const GridBox& bounds) {
  if (!bounds.empty()) plan.scale->require(path, plan.grid.box(bounds));
}

void add_source(TerrainSource& source, std::uint16_t number, const ImportPlan& plan, PointSorter& sorter,
                ImportReport& report, Progress& progress) {
  std::vector<RawPoint> raw;
  const ReadCounts counts = source.read(
      [&](std::span<const GridPoint> points) {
        raw.clear();
        for (const GridPoint& p : points) raw.push_back({morton(p.x, p.y), p.z, number, 0});
        sorter.add(raw);
      },
      progress);
  require_true_scale(plan, source.info().path, counts.bounds);
  report.read += counts.read;
  report.voids += counts.voids;
  report.filtered += counts.filtered;
  report.warnings.insert(report.warnings.end(), counts.warnings.begin(), counts.warnings.end());
}

void add_lines(LineLayer& layer, std::uint16_t number, const ImportPlan& plan, const ImportOptions& options,
               LineCollection& lines, ImportReport& report, Progress& progress) {
  const std::uint32_t theme = lines.theme(options.theme, *options.kind, false);
  const ReadCounts counts = layer.read(
      {plan.grid, plan.crs_wkt},
      [&](std::span<const GridPoint> line) {
        lines.add(theme, number, line);
        lines.require_room(layer.path());
      },
      progress);
  require_true_scale(plan, layer.path(), counts.bounds);
  lines.add_features(theme, layer.features());
  report.read += counts.read;
  report.read_features += layer.features();
  report.voids += counts.voids;
  report.filtered += counts.filtered;
  report.features += layer.features();
  report.warnings.insert(report.warnings.end(), counts.warnings.begin(), counts.warnings.end());
}

/// The vertices of the terrain's lines are points of the full surface.
void add_line_vertices(const ThemeLines& lines, PointSorter& sorter) {
  for (const std::uint32_t v : lines.terrain_vertices()) {
    const GridPoint& p = lines.lines.vertices[v];
    sorter.add({code_of(p), p.z, lines.sources[v], 0});
  }
}

bool may_stand(ThemeKind kind) {
  return kind == ThemeKind::Buildings || kind == ThemeKind::Vegetation || kind == ThemeKind::Walls;
}

/// Names stand in lists with commas, beside `all` and `none`.
void require_theme_name(const std::string& name) {
  if (name == "all" || name == "none" || name.find(',') != std::string::npos)
    throw InputError(fmt::format("theme '{}': choose a name without commas, other than all and none", name));
}

std::string directory_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// The sources that one import adds to a store.
struct Additions {
  ImportPlan plan;
  std::vector<FootprintFile> footprints;

  /// As in every turn after the first.
  bool empty() const { return plan.sources.empty() && plan.lines.empty() && footprints.empty(); }
};

void add_footprints(FootprintFile& file, std::uint16_t number, const ImportOptions& options, LineCollection& lines,
                    ImportReport& report) {
  const std::uint32_t theme = lines.theme(options.theme, *options.kind, true);
  report.read_features += file.footprints.features.size();
  report.read += file.vertices;
  report.filtered += file.footprints.filtered;
  for (FootprintFeature& feature : file.footprints.features) lines.add_footprint(theme, {std::move(feature), number});
  lines.require_room(file.info.path);
}

std::vector<SourceRank> ranks_for_sorting(const std::vector<SourceInfo>& sources) {
  const std::vector<std::uint32_t> order = ranks_of(sources);
  std::vector<SourceRank> ranks;
  for (std::size_t s = 0; s < sources.size(); ++s)
    ranks.push_back({sources[s].spacing, is_ground(sources[s]), !sources[s].theme.empty(), order[s]});
  return ranks;
}

void set_lines_aside(const std::vector<SetAsideLines>& of_themes, StoreWriter& writer) {
  for (std::size_t t = 0; t < of_themes.size(); ++t) writer.set_aside(static_cast<std::uint16_t>(t + 1), of_themes[t]);
}

/// The counts of a store, which may be null.
SetAsideCounts counts_of(const Store* store) {
  return store == nullptr ? SetAsideCounts{} : set_aside_list(file_of(*store).rows()).counts;
}

/// Sums over the parts of each theme.
std::vector<ThemeInfo> counted_themes(const LineCollection& collection, const ThemeLines& lines,
                                      const PyramidReport& pyramid) {
  std::vector<ThemeInfo> themes = collection.themes();
  for (std::size_t t = 0; t < themes.size(); ++t) {
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

/// Where the store goes, and where what comes before it.
struct Target {
  StoreWriter& writer;
  std::string passing;  ///< path
  bool last = false;    ///< it goes where it is to go, whatever
  std::vector<double> tolerances;
};

/// Writes a store of all that `base` (may be null) holds and the additions. Standing features are raised on the ground
/// of `ground`, and cut its lines there; without, lines are laid as they were imported, and footprints only kept. False
/// where features need another turn, on the ground of the passing store that was written instead, which has no points
/// at other levels: this one has other ground than they were raised on, or they were not.
bool write_store(const Target& target, const Store* base, Additions& additions, const Store* ground,
                 const ImportOptions& options, ImportReport& report, RaisedFeatures& raised, Progress& progress) {
  const ImportPlan& plan = additions.plan;
  std::vector<SourceInfo> sources = imported_sources(base);
  // One more may stand for inferred points.
  if (sources.size() + plan.sources.size() + plan.lines.size() + additions.footprints.size() >= format::kMaxSources)
    throw InputError("a store holds at most 32,766 sources; merge some of them first");
  PointSorter sorter(directory_of(target.passing), options.memory_bytes / 2);
  LineCollection collection(ground == nullptr ? LinesAs::imported : LinesAs::laid, options.memory_bytes);
  const StoredPoints stored = base != nullptr ? add_stored(*base, sorter, collection, progress) : StoredPoints{};
  for (const auto& source : plan.sources) {
    add_source(*source, static_cast<std::uint16_t>(sources.size()), plan, sorter, report, progress);
    sources.push_back(recorded(source->info()));
    sources.back().replaces = options.replace;
  }
  for (const auto& layer : plan.lines) {
    add_lines(*layer, static_cast<std::uint16_t>(sources.size()), plan, options, collection, report, progress);
    sources.push_back(recorded(layer->info()));
  }
  for (FootprintFile& file : additions.footprints) {
    add_footprints(file, static_cast<std::uint16_t>(sources.size()), options, collection, report);
    sources.push_back(recorded(file.info));
  }
  const bool repair = will_repair(options, base);
  if (repair) sources.push_back(inferred_source());
  if (!additions.empty()) require_points(report, options, stored.count > 0);
  if (ground != nullptr) collection.raise(*ground, raised, progress);

  const ThemeLines lines = collection.finish(sources, ground, progress);
  add_line_vertices(lines, sorter);
  const bool done = target.last || !collection.stands() || (ground != nullptr && !collection.changes_terrain(lines));
  std::optional<StoreWriter> passing;
  if (!done) passing.emplace(target.passing, plan.crs_wkt, plan.grid, target.tolerances);
  StoreWriter& writer = done ? target.writer : *passing;

  std::uint64_t duplicates = 0;
  SortedPoints points = sorter.finish(ranks_for_sorting(sources), progress, &duplicates);
  report.duplicates += duplicates;
  // Ground that features stand on stays as it is.
  const PyramidReport pyramid =
      build_pyramid(points, sources, plan.grid, done ? target.tolerances : std::vector<double>{0.0}, lines,
                    ground != nullptr && collection.stands() ? &stored.inferred : nullptr, writer, progress);
  set_lines_aside(set_aside_of(collection.imported(), pyramid.placed, lines), writer);
  const SetAsideCounts before = counts_of(ground);
  const SetAsideCounts counts{pyramid.replaced, pyramid.isolated, ground ? before.segments : pyramid.left_out,
                              ground ? before.crossings : lines.lines.crossings};
  writer.count_set_aside(counts);
  if (ground != nullptr) report.crossings = std::max(report.crossings, lines.lines.crossings);
  report.flat_before = pyramid.flat_before;
  report.flat_after = pyramid.flat_after;
  if (repair) report.inferred = pyramid.vertices_of_source.back();
  report.vertices = 0;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    sources[s].vertices = pyramid.vertices_of_source[s];
    report.vertices += sources[s].vertices;
  }
  require_ground(report, options);
  std::vector<ThemeInfo> themes = counted_themes(collection, lines, pyramid);
  writer.add_footprints(themes, collection.footprints());
  std::vector<ThemePart> parts;
  for (const PlacedPart& part : lines.parts) parts.push_back(part.part);
  writer.commit(std::move(sources), std::move(themes), std::move(parts));
  return done;
}

/// Reports the changes from `before` to `now`.
void report_counts(const SetAsideCounts& before, const SetAsideCounts& now, ImportReport& report) {
  const auto more = [](std::uint64_t n, std::uint64_t than) { return n - std::min(n, than); };
  report.replaced = more(now.replaced, before.replaced);
  report.isolated = more(now.isolated, before.isolated);
  report.left_out = more(now.segments, before.segments);
  report.crossings = std::max(report.crossings, more(now.crossings, before.crossings));
}

Additions plan_additions(const ImportOptions& options, const Store* store, Progress& progress) {
  Additions additions;
  if (stands(options)) {
    additions.footprints = read_footprint_files(options, store->metadata(), progress);
    additions.plan = plan_nothing(store->metadata());
    for (FootprintFile& file : additions.footprints) {
      std::vector<std::string>& warnings = file.footprints.warnings;
      std::move(warnings.begin(), warnings.end(), std::back_inserter(additions.plan.warnings));
    }
  } else {
    additions.plan = plan_import(options, store != nullptr ? &store->metadata() : nullptr);
  }
  return additions;
}

/// Features are raised at most so many times. After that, few vertices that they give to lines of the ground are left,
/// within a grid step or two of others.
constexpr int kMostRaised = 3;

/// Whether a store's ground, which may be null, is that of its terrain and lines alone, as they were imported: nothing
/// that stands has cut any.
bool may_stand_on(const Store* store) {
  if (store == nullptr) return false;
  const std::vector<ThemeInfo>& themes = store->metadata().themes;
  const auto stands = [](const ThemeInfo& theme) { return theme.stands(); };
  return std::all_of(themes.begin(), themes.end(), stands) || std::none_of(themes.begin(), themes.end(), stands);
}

/// Raised features need their ground finished first, and give vertices to lines of the ground where they cross them.
void write_in_turns(const std::string& store_path, StoreWriter& writer, const std::vector<double>& tolerances,
                    const std::optional<Store>& existing, Additions additions, const ImportOptions& options,
                    ImportReport& report, Progress& progress) {
  const Store* base = existing ? &*existing : nullptr;
  const Store* ground = may_stand_on(base) && !additions.footprints.empty() ? base : nullptr;
  std::deque<Unfinished> passing;  // stores for the time of this import only
  std::optional<Store> before;
  RaisedFeatures raised;
  for (int raisings = 0;;) {
    raisings += ground != nullptr ? 1 : 0;
    passing.emplace_back(fmt::format("{}.ground{}", store_path, passing.size()));
    const Target target{writer, passing.back().path(), raisings == kMostRaised, tolerances};
    if (write_store(target, base, additions, ground, options, report, raised, progress)) break;
    base = ground = &before.emplace(passing.back().path());
    additions = Additions{plan_nothing(base->metadata()), {}};
  }
  report.features += raised.features;
  report.refused += raised.refused;
  const std::vector<std::string> warnings = standing_warnings(raised, existing ? &existing->metadata() : nullptr,
                                                              imported_sources(existing ? &*existing : nullptr).size());
  report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
}

ImportReport import_sources(const std::string& store_path, const ImportOptions& options, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  if (options.sources.empty()) throw InputError("no source given: name at least one file to import");
  const Stoppable stoppable(progress);
  static_cast<void>(utc_now());  // a wrong SOURCE_DATE_EPOCH is noticed before hours of work
  // First of all: another import could change the store once it has been opened. And a place that cannot be written is
  // known before hours of work.
  auto file = std::make_unique<ReplacementFile>(store_path);
  std::optional<Store> existing;
  if (std::filesystem::exists(store_path)) existing.emplace(store_path);
  const Store* const store = existing ? &*existing : nullptr;
  check_resolution(options, store);
  const std::vector<double> tolerances = tolerances_of(options, store);
  Additions additions = plan_additions(options, store, progress);

  ImportReport report;
  report.crs_name = additions.plan.crs_name;
  report.crs_chosen = additions.plan.crs_chosen;
  report.warnings = additions.plan.warnings;
  if (options.kind == ThemeKind::Contours && options.repair && !will_repair(options, store))
    report.warnings.push_back(
        fmt::format("contours are left flat: {} has some that were imported with `repair = false`", store_path));

  const SetAsideCounts before = counts_of(store);
  StoreWriter writer(std::move(file), additions.plan.crs_wkt, additions.plan.grid, tolerances);
  write_in_turns(store_path, writer, tolerances, existing, std::move(additions), options, report, progress);

  const Store written(store_path);
  report_counts(before, counts_of(&written), report);
  report.store_bytes = written.file_bytes();
  report.levels = written.metadata().levels;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace

ImportReport import_terrain(const std::string& store_path, const ImportOptions& options, Progress& progress) {
  ImportOptions terrain = options;
  terrain.kind.reset();
  return import_sources(store_path, terrain, progress);
}

ImportReport import_lines(const std::string& store_path, const ImportOptions& options, Progress& progress) {
  if (!options.kind) throw InputError("lines: say of which kind they are");
  ImportOptions lines = options;
  if (lines.theme.empty()) lines.theme = name_of(*options.kind);
  require_theme_name(lines.theme);
  if (options.kind != ThemeKind::Contours && !std::filesystem::exists(store_path)) {
    throw InputError(fmt::format("{}: there is no such store; {} need ground to lie on, so import terrain first",
                                 store_path, name_of(*options.kind)));
  }
  ImportReport report = import_sources(store_path, lines, progress);
  if (may_stand(*options.kind) && !stands(options)) {
    report.warnings.push_back(
        fmt::format("{} without heights are outlines on the ground; to make them stand, give "
                    "`height_field` or `height`, and another `theme`",
                    name_of(*options.kind)));
  }
  return report;
}

}  // namespace itin
