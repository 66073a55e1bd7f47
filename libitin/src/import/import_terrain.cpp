#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include <itin/import.hpp>
#include <itin/store.hpp>

#include "import/sorted_points.hpp"
#include "import/terrain_source.hpp"
#include "pyramid/pyramid.hpp"
#include "store/point_index.hpp"
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
      throw InputError("--levels: " + existing->path() + " has other levels already; leave --levels out to add to it");
    }
    return stored;
  }
  std::vector<double> tolerances{0.0};
  for (const double t : options.tolerances.empty() ? kDefaultTolerances : options.tolerances) {
    if (!std::isfinite(t) || t <= tolerances.back())
      throw InputError("--levels: tolerances must be positive and ascending");
    if (t < options.resolution)
      throw InputError("--levels: a tolerance below the resolution means nothing; raise it or lower --resolution");
    tolerances.push_back(t);
  }
  return tolerances;
}

void check_resolution(const ImportOptions& options, const Store* existing) {
  if (!std::isfinite(options.resolution) || options.resolution <= 0)
    throw InputError("--resolution: must be positive, in metres");
  if (existing != nullptr && options.resolution != ImportOptions{}.resolution &&
      options.resolution != existing->metadata().grid.resolution) {
    throw InputError("--resolution: " + existing->path() +
                     " has another one already; leave it out to add to the store");
  }
}

/// Adds the points that a store holds already.
std::uint64_t add_stored(const Store& store, PointSorter& sorter, Progress& progress) {
  std::vector<Leaf> leaves;
  store.points().leaves(0, store.points().bounds(), leaves);
  std::uint64_t count = 0;
  std::vector<RawPoint> points;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    progress.throw_if_cancelled();
    const auto block = store.points().block(leaves[i]);
    points.clear();
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      points.push_back({morton(p.x, p.y), p.z, block->sources[k], 0});
    }
    sorter.add(points);
    count += points.size();
    progress.report("reading the store", static_cast<double>(i + 1) / static_cast<double>(leaves.size()));
  }
  return count;
}

void add_source(TerrainSource& source, std::uint16_t number, PointSorter& sorter, ImportReport& report,
                Progress& progress) {
  std::vector<RawPoint> raw;
  const ReadCounts counts = source.read(
      [&](std::span<const GridPoint> points) {
        raw.clear();
        for (const GridPoint& p : points) raw.push_back({morton(p.x, p.y), p.z, number, 0});
        sorter.add(raw);
      },
      progress);
  report.read += counts.read;
  report.voids += counts.voids;
  report.filtered += counts.filtered;
  report.warnings.insert(report.warnings.end(), counts.warnings.begin(), counts.warnings.end());
}

std::string directory_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

}  // namespace

ImportReport import_terrain(const std::string& store_path, const ImportOptions& options, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  if (options.sources.empty()) throw InputError("no source given: name at least one file to import");
  std::optional<Store> existing;
  if (std::filesystem::exists(store_path)) existing.emplace(store_path);
  const Store* const store = existing ? &*existing : nullptr;
  check_resolution(options, store);
  const std::vector<double> tolerances = tolerances_of(options, store);
  const ImportPlan plan = plan_import(options, store != nullptr ? &store->metadata() : nullptr);

  ImportReport report;
  report.crs_name = plan.crs_name;
  report.crs_chosen = plan.crs_chosen;
  report.warnings = plan.warnings;
  std::vector<SourceInfo> sources;
  if (store != nullptr) sources = store->metadata().sources;
  if (sources.size() + plan.sources.size() > 65535)
    throw InputError("a store holds at most 65,535 sources; merge some of them first");

  // The writer comes first: it holds the lock, and a place that cannot be written is known before hours of work.
  StoreWriter writer(store_path, plan.crs_wkt, plan.grid, tolerances);
  PointSorter sorter(directory_of(store_path), options.memory_bytes / 2);
  std::uint64_t offered = store != nullptr ? add_stored(*store, sorter, progress) : 0;
  for (const auto& source : plan.sources) {
    add_source(*source, static_cast<std::uint16_t>(sources.size()), sorter, report, progress);
    sources.push_back(source->info());
    sources.back().replaces = options.replace;
  }
  offered += report.read;
  if (offered == 0) throw InputError("nothing to import: the sources hold no point with a height");

  std::vector<double> spacings;
  for (const SourceInfo& source : sources) spacings.push_back(source.spacing);
  SortedPoints points = sorter.finish(spacings, progress, &report.duplicates);
  const PyramidReport pyramid = build_pyramid(points, sources, plan.grid, tolerances, writer, progress);
  report.replaced = pyramid.replaced;
  report.isolated = pyramid.isolated;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    sources[s].vertices = pyramid.vertices_of_source[s];
    report.vertices += sources[s].vertices;
  }
  if (report.vertices == 0)
    throw InputError("nothing to import: no three points are near enough to each other to be ground (see --max-gap)");
  writer.commit(std::move(sources));

  const Store written(store_path);
  report.store_bytes = written.file_bytes();
  report.levels = written.metadata().levels;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace itin
