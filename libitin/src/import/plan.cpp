#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/window_source.hpp>

#include "gdal/files/archive.hpp"
#include "gdal/files/source_path.hpp"
#include "import/points/point_source.hpp"
#include "import/rasters/raster_source.hpp"
#include "import/rasters/sea_source.hpp"
#include "import/source/crs_doubts.hpp"
#include "import/source/source_context.hpp"
#include "import/source/source_options.hpp"
#include "import/source/terrain_source.hpp"
#include "import/source/true_scale.hpp"
#include "import/source/vertical_datums.hpp"
#include "import/vectors/line_layer.hpp"
#include "pyramid/pyramid.hpp"

namespace itin {

namespace {

using SourceFiles = std::vector<std::unique_ptr<SourceFile>>;
constexpr double kHighestSea = 10000;  // metres, above or below zero

using OpenedFiles = std::vector<const OpenedFile*>;

// A finer resolution would not fit heights of 20 km; with a coarser one the posts of detailed models would fall
// together.
constexpr double kFinestResolution = 0.0001, kCoarsestResolution = 10;

bool is_las(const std::string& path) {
  std::array<char, 4> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  return std::string_view(magic.data(), magic.size()) == "LASF";
}

/// The files that a source stands for: the files in an archive, or itself.
struct Identified {
  std::vector<std::string> paths;
  SourceKind kind;
};

/// GDAL's name of the layer of points in a .zip. Tables of points are read without GDAL.
std::string points_in_archive(const std::string& path) {
  std::string inside = within_archive(path, "raster or vector file");
  if (is_delimited_text(inside)) throw FileError(path, "holds a table; unpack it");
  return inside;
}

Identified identify(const std::string& path) {
  require_plain_file(path);
  if (is_las(path)) return {{path}, SourceKind::las};
  if (std::vector<std::string> rasters = find_rasters(path); !rasters.empty())
    return {std::move(rasters), SourceKind::raster};
  if (is_missing(path)) throw FileError(path, "there is no such file");
  if (ending_of(path) == ".zip") return {{points_in_archive(path)}, SourceKind::points};
  return {{path}, is_delimited_text(path) ? SourceKind::text : SourceKind::points};
}

SourceFiles open_terrain(const ImportOptions& options) {
  std::vector<Identified> files;
  std::vector<SourceKind> kinds;
  for (const std::string& path : options.sources) {
    files.push_back(identify(path));
    kinds.push_back(files.back().kind);
  }
  require_useful_options(options, kinds);
  SourceFiles opened;
  for (const auto& [paths, kind] : files) {
    for (const std::string& path : paths)
      opened.push_back(kind == SourceKind::las      ? open_las_source(path, options)
                       : kind == SourceKind::raster ? open_raster_source(path, options)
                                                    : open_point_source(path, options));
  }
  return opened;
}

std::vector<std::unique_ptr<LineLayer>> open_lines(const ImportOptions& options) {
  require_useful_options(options, std::array{kind_of_lines(*options.kind)});
  std::vector<std::unique_ptr<LineLayer>> layers;
  for (const std::string& path : options.sources) layers.push_back(std::make_unique<LineLayer>(path, options));
  return layers;
}

Crs metric_crs(const std::string& text, const std::string& place) {
  Crs crs = parse_crs(text, place);
  if (!crs.fits_store())
    throw InputError(
        fmt::format("{}: {} is not projected with axes in metres, to the east and to the north, as a store's CRS must "
                    "be; choose one that is, such as a UTM zone",
                    place, crs.name),
        "to_crs");
  return crs;
}

struct StoreCrs {
  Crs crs;
  bool chosen = false;
  std::string why = {};  ///< why it was chosen, though the source's own is metric
};

StoreCrs choose_crs(const ImportOptions& options, const StoreMetadata* existing, const OpenedFile& first) {
  if (existing) {
    const StoreCrs fixed{parse_crs(existing->crs_wkt, "the store's CRS")};
    if (!options.to_crs.empty() &&
        !PointTransform(metric_crs(options.to_crs, "`to_crs`").wkt, fixed.crs.wkt, "`to_crs`").identity())
      throw InputError(fmt::format("`to_crs` {}: the store's CRS is {} already; leave the option out, or import into a "
                                   "new store",
                                   options.to_crs, fixed.crs.name),
                       "to_crs");
    return fixed;
  }
  if (!options.to_crs.empty()) return {metric_crs(options.to_crs, "`to_crs`")};
  const Crs crs = first.crs();
  if (!crs.fits_store()) {
    const Crs zone = utm_zone(crs, first.centre(), first.path());
    return {zone, true,
            crs.east_north ? ""
                           : fmt::format("{}: the axes of its CRS, {}, do not run to the east and to the north; the "
                                         "store's is {} instead",
                                         first.path(), crs.name, zone.name)};
  }
  const GridScale scale = TrueScale(crs, false).of(first);
  if (scale.is_true()) return {crs};
  const Crs zone = utm_zone(crs, first.centre(), first.path());
  return {zone, true,
          fmt::format("{}: lengths in its CRS, {}, are {}; the store's is {} instead", first.path(), crs.name,
                      error_in_words(scale), zone.name)};
}

/// Returns a warning; empty where there is nothing to say.
std::string check_vertical_datums(const OpenedFiles& opened, const ImportOptions& options,
                                  const StoreMetadata* existing) {
  if (options.allow_mixed_vertical || (options.kind && !is_terrain(*options.kind))) return {};
  VerticalDatums datums = existing ? VerticalDatums(*existing) : VerticalDatums();
  if (const Crs crs = options.to_crs.empty() ? Crs{} : parse_crs(options.to_crs, "`to_crs`"); crs.heights)
    datums.add(crs, "`to_crs`");
  for (const OpenedFile* file : opened) datums.add(file->crs(), file->path());
  return datums.warning();
}

Grid choose_grid(const ImportOptions& options, const StoreMetadata* existing, const OpenedFile& first, const Crs& crs) {
  if (existing) return existing->grid;
  if (!(options.resolution >= kFinestResolution && options.resolution <= kCoarsestResolution))
    throw InputError(fmt::format("`resolution` {}: give {} to {} metres", options.resolution, kFinestResolution,
                                 kCoarsestResolution),
                     "resolution");
  const std::string& place = options.sources.front();
  Point2 centre = first.centre();
  PointTransform(first.crs().wkt, crs.wkt, place).transform(std::span(&centre.x, 1), std::span(&centre.y, 1));
  if (!std::isfinite(centre.x) || !std::isfinite(centre.y))
    throw InputError(fmt::format("{}: lies where {} is not defined; choose another CRS with `to_crs`", place, crs.name),
                     "to_crs");
  const double step = kGridHalfSide * options.resolution;
  // Adding zero turns -0, which would be written differently, into 0.
  return {{std::round(centre.x / step) * step + 0.0, std::round(centre.y / step) * step + 0.0}, options.resolution};
}

/// The box that all of the files' posts are known to lie in, in the store's CRS.
Box box_about(const OpenedFiles& files, const Crs& crs) {
  Box box;
  for (const OpenedFile* file : files) {
    const PointTransform transform(file->crs().wkt, crs.wkt, file->path());
    const Box extent = file->extent();
    std::vector<Point2> places = places_in(extent);
    for (const double x : {extent.xmin, extent.xmax})
      for (const double y : {extent.ymin, extent.ymax}) places.push_back({x, y});
    for (Point2& p : places) {
      transform.transform(std::span(&p.x, 1), std::span(&p.y, 1));
      if (std::isfinite(p.x) && std::isfinite(p.y)) box.extend(p);
    }
  }
  return box;
}

/// Requires that a store has one sea: where two overlapped at different heights, neither would be level.
void require_one_sea(double level, const StoreMetadata* existing) {
  if (existing == nullptr) return;
  for (const SourceInfo& source : existing->sources)
    if (is_sea(source) && source.path != sea_name(level))
      throw InputError(
          fmt::format("`sea_level` {:g}: the store has the {} already; give the same, or import into a new "
                      "store",
                      level, source.path),
          "sea_level");
}

void fill_sea(const ImportOptions& options, const StoreMetadata* existing, const Box& box, const Crs& crs,
              ImportPlan& plan) {
  if (!options.sea_level) throw InputError("`sea_area`: give `sea_level` with it", "sea_area");
  if (!std::isfinite(*options.sea_level) || std::abs(*options.sea_level) > kHighestSea)
    throw InputError(
        fmt::format("`sea_level` {0:g}: give metres between -{1:g} and {1:g}", *options.sea_level, kHighestSea),
        "sea_level");
  require_one_sea(*options.sea_level, existing);
  std::optional<Window> area;
  if (!options.sea_area.empty()) area = window_from_polygon(options.sea_area, crs.wkt);
  SeaFill sea(*options.sea_level, area, box, plan.grid);
  for (std::unique_ptr<TerrainSource>& source : plan.sources) source = sea.watch(std::move(source));
  plan.sources.push_back(std::move(sea).source());
}

}  // namespace

ImportPlan::ImportPlan() = default;
ImportPlan::ImportPlan(ImportPlan&&) noexcept = default;
ImportPlan& ImportPlan::operator=(ImportPlan&&) noexcept = default;
ImportPlan::~ImportPlan() = default;

ImportPlan plan_import(const ImportOptions& options, const StoreMetadata* existing) {
  if (options.sources.empty()) throw InputError("import: name at least one source", "sources");
  ImportPlan plan;
  SourceFiles points;
  if (options.kind) {
    plan.lines = open_lines(options);
  } else {
    points = open_terrain(options);
  }
  OpenedFiles opened;
  for (const auto& file : points) opened.push_back(file.get());
  for (const auto& file : plan.lines) opened.push_back(file.get());
  if (std::string warning = check_vertical_datums(opened, options, existing); !warning.empty())
    plan.warnings.push_back(std::move(warning));
  const auto [crs, chosen, why] = choose_crs(options, existing, *opened.front());
  if (!why.empty()) plan.warnings.push_back(why);
  plan.scale = std::make_unique<TrueScale>(crs, existing != nullptr);
  for (const OpenedFile* file : opened) plan.scale->require(*file);
  plan.crs_wkt = crs.wkt;
  plan.crs_name = crs.name;
  plan.crs_chosen = chosen;
  plan.grid = choose_grid(options, existing, *opened.front(), crs);
  for (const OpenedFile* file : opened) {
    std::vector<std::string> warnings = file->warnings();
    std::move(warnings.begin(), warnings.end(), std::back_inserter(plan.warnings));
    for (std::string& doubt : crs_doubts(file->path(), file->crs(), file->extent()))
      plan.warnings.push_back(std::move(doubt));
  }
  const Box box = options.sea_level ? box_about(opened, crs) : Box{};  // needed before the files are bound
  for (const auto& file : points) plan.sources.push_back(file->bind({plan.grid, plan.crs_wkt, &plan.scale->meter()}));
  if (options.sea_level || !options.sea_area.empty()) fill_sea(options, existing, box, crs, plan);
  return plan;
}

ImportPlan plan_nothing(const StoreMetadata& existing) {
  ImportPlan plan;
  const Crs crs = parse_crs(existing.crs_wkt, "the store's CRS");
  plan.crs_wkt = crs.wkt;
  plan.crs_name = crs.name;
  plan.grid = existing.grid;
  return plan;
}

}  // namespace itin
