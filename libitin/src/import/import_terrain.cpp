#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/unfinished.hpp>

#include "base/stoppable.hpp"
#include "import/footprints/footprint_file.hpp"
#include "import/raised_warnings.hpp"
#include "import/removed_sources.hpp"
#include "import/source/source_context.hpp"
#include "import/source/source_options.hpp"
#include "import/source/terrain_source.hpp"
#include "import/store_pass.hpp"
#include "import/stored_sources.hpp"
#include "pyramid/kept_ground.hpp"
#include "store/store_writer.hpp"

namespace itin {

namespace {

const std::vector<double> kDefaultTolerances{0.5, 1, 2, 4, 8, 16, 32};

/// The tolerances, level 0 first. An existing store's levels stay as they are.
std::vector<double> tolerances_of(const ImportOptions& options, const Store* existing) {
  if (existing != nullptr) {
    std::vector<double> stored;
    for (const LevelInfo& level : existing->metadata().levels) stored.push_back(level.tolerance);
    if (!options.tolerances.empty() &&
        !std::equal(options.tolerances.begin(), options.tolerances.end(), stored.begin() + 1, stored.end())) {
      throw InputError(
          "`tolerances`: " + existing->path() + " has other levels already; leave `tolerances` out to add to it",
          "tolerances");
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
      throw InputError("`tolerances`: tolerances must be positive and ascending", "tolerances");
    if (t < options.resolution)
      throw InputError("`tolerances`: a tolerance below the resolution means nothing; raise it or lower `resolution`",
                       "tolerances");
    tolerances.push_back(t);
  }
  return tolerances;
}

void check_resolution(const ImportOptions& options, const Store* existing) {
  if (!std::isfinite(options.resolution) || options.resolution <= 0)
    throw InputError("`resolution`: must be positive, in metres", "resolution");
  if (existing != nullptr && options.resolution != ImportOptions{}.resolution &&
      options.resolution != existing->metadata().grid.resolution) {
    throw InputError("`resolution`: " + existing->path() + " has another one already; leave it out to add to the store",
                     "resolution");
  }
}

/// Refuses names that would be mistaken: they stand in lists with commas, beside `all` and `none`.
void require_theme_name(const std::string& name) {
  if (name == "all" || name == "none" || name == "terrain" || name.find(',') != std::string::npos)
    throw InputError(fmt::format("theme '{}': choose a name without commas, other than all, none and terrain", name),
                     "theme");
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
  if (options.sources.empty()) require_useful_options(options, {});
  Additions additions;
  additions.removed = removed_sources(options.remove, store);
  if (options.sources.empty()) {
    additions.plan = plan_nothing(store->metadata());
  } else if (builds_features(options)) {
    additions.footprints = read_footprint_files(options, *store, progress);
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

/// The most times that features are raised. After that, few vertices that they give to lines of the ground are left,
/// and these lie within a grid step or two of others.
constexpr int kMostRaised = 3;

/// Whether a store's ground, which may be null, is that of its terrain and lines alone, as they were imported: no
/// feature that stands has cut any of it.
bool has_uncut_ground(const Store* store) {
  if (store == nullptr) return false;
  const std::vector<ThemeInfo>& themes = store->metadata().themes;
  const auto raised = [](const ThemeInfo& theme) { return theme.is_raised(); };
  return std::all_of(themes.begin(), themes.end(), raised) || std::none_of(themes.begin(), themes.end(), raised);
}

bool has_raised(const Store* store) {
  if (store == nullptr) return false;
  return ThemeChoice::all().includes_raised(store->metadata().themes);
}

/// Says why the ground of a store that was there is made again; empty where it stays.
std::string why_made_again(const Store& store, const Additions& additions) {
  if (!additions.plan.sources.empty()) return "terrain is added";
  if (!additions.plan.lines.empty()) return "lines on the ground are added";
  return may_keep_ground(store.metadata()) ? "" : "lines lie on it";
}

/// Writes the store in passes. Raised features need their ground finished first, and give vertices to lines of the
/// ground where they cross them.
void write_in_passes(Target target, const Store* existing, Additions additions, const ImportOptions& options,
                     ImportReport& report, CallProgress& call) {
  if (existing != nullptr) report.ground_made_again = why_made_again(*existing, additions);
  const bool keeps = existing != nullptr && report.ground_made_again.empty();
  const bool raises = !keeps && (!additions.footprints.empty() || has_raised(existing));
  const Store* base = existing;
  const Store* ground = keeps || (has_uncut_ground(base) && !additions.footprints.empty()) ? base : nullptr;
  std::vector<std::uint16_t> added;
  std::deque<Unfinished> interim;  // stores for the time of this import only
  std::optional<Store> before;
  RaisedFeaturesReport raised;
  for (int raisings = 0;;) {
    raisings += ground != nullptr ? 1 : 0;
    interim.emplace_back(fmt::format("{}.ground{}", target.path, interim.size()));
    target.interim = interim.back().path(), target.last = raisings == kMostRaised;
    StorePass pass(target, {base, ground, keeps, additions}, options, report);
    const bool done = pass.run(raised, call.step(raises ? 0.5 : 1));
    if (base == existing) added = pass.added();
    if (done) break;
    base = ground = &before.emplace(interim.back().path());
    additions = Additions{plan_nothing(base->metadata()), {}};
  }
  report.features += raised.features;
  report.refused += raised.refused;
  const std::vector<std::string> warnings =
      raised_warnings(raised, existing != nullptr ? &existing->metadata() : nullptr, added);
  report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
}

ImportReport import_sources(const std::string& store_path, const ImportOptions& options, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  if (options.sources.empty() && options.remove.empty())
    throw InputError("no source given: name at least one file to import", "sources");
  const Stoppable stoppable(progress);
  static_cast<void>(utc_now());  // a wrong SOURCE_DATE_EPOCH is noticed before hours of work
  // The file comes first, for another import could change the store once it has been opened. A place that cannot be
  // written is noticed before hours of work, too.
  auto file = std::make_unique<ReplacementFile>(store_path);
  std::optional<Store> existing;
  if (std::filesystem::exists(store_path)) existing.emplace(store_path);
  const Store* const store = existing ? &*existing : nullptr;
  check_resolution(options, store);
  const std::vector<double> tolerances = tolerances_of(options, store);
  CallProgress call(progress);
  Additions additions = plan_additions(options, store, call.step(builds_features(options) ? 0.1 : 0));

  ImportReport report;
  report.crs_name = additions.plan.crs_name;
  report.crs_chosen = additions.plan.crs_chosen;
  report.warnings = additions.plan.warnings;
  if (options.kind == ThemeKind::Contours && options.repair && !will_repair(options, store))
    report.warnings.push_back(
        fmt::format("contours are left flat: {} has some that were imported with `repair = false`", store_path));

  const SetAsideCounts before = counts_of(store);
  StoreWriter writer(std::move(file), additions.plan.crs_wkt, additions.plan.grid, tolerances);
  write_in_passes({writer, store_path, tolerances}, store, std::move(additions), options, report, call);

  const Store written(store_path);
  report_counts(before, counts_of(&written), report);
  report.store_bytes = written.file_bytes();
  report.levels = written.metadata().levels;
  call.finish();
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
  if (!options.kind) throw InputError("lines: say of which kind they are", "kind");
  ImportOptions lines = options;
  if (lines.theme.empty()) lines.theme = name_of(*options.kind);
  require_theme_name(lines.theme);
  if (options.kind != ThemeKind::Contours && !std::filesystem::exists(store_path)) {
    throw InputError(fmt::format("{}: there is no such store; {} need ground to lie on, so import terrain first",
                                 store_path, name_of(*options.kind)));
  }
  ImportReport report = import_sources(store_path, lines, progress);
  if (!options.sources.empty() && may_be_raised(*options.kind) && !builds_features(options)) {
    report.warnings.push_back(
        fmt::format("{} without heights are outlines on the ground; to make them stand, give "
                    "`height_field` or `height`, and another `theme`",
                    name_of(*options.kind)));
  }
  return report;
}

}  // namespace itin
