#include "import/footprints/footprint_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/file_ending.hpp>
#include <itin/raster_values.hpp>
#include <itin/sources_in.hpp>

#include "gdal/files/source_path.hpp"
#include "import/footprints/city_json.hpp"
#include "import/footprints/height_raster.hpp"
#include "import/footprints/surface_heights.hpp"
#include "import/points/scattered_source.hpp"
#include "import/source/source_options.hpp"

namespace itin {

namespace {

/// Tells CityJSON by the file's name, and by a word that the format asks for near the beginning: members come in any
/// order.
bool is_city_json(const std::string& path) {
  constexpr std::array kEndings{".json", ".cityjson", ".jsonl"};
  if (std::find(kEndings.begin(), kEndings.end(), ending_of(path)) == kEndings.end()) return false;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(std::size_t{1} << 16, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return beginning.find("\"CityJSON\"") != std::string::npos || beginning.find("\"CityObjects\"") != std::string::npos;
}

FeatureKind feature_kind(ThemeKind kind) {
  switch (kind) {
    case ThemeKind::Walls:
      return FeatureKind::wall;
    case ThemeKind::Vegetation:
      return FeatureKind::vegetation;
    case ThemeKind::Terraces:
      return FeatureKind::terrace;
    default:
      return FeatureKind::building;
  }
}

/// Whether a file is a raster of heights that stand. Walls are lines in any case.
bool is_height_raster(const std::string& path, const ImportOptions& options) {
  const bool may_be = options.kind == ThemeKind::Surface || options.kind == ThemeKind::Vegetation ||
                      options.kind == ThemeKind::Buildings;
  if (!may_be) return false;
  require_plain_file(path);
  return is_raster(path);
}

SourceKind kind_of(const std::string& path, const ImportOptions& options) {
  if (is_city_json(path)) return SourceKind::city_model;
  if (options.kind == ThemeKind::Surface) return SourceKind::surface;
  if (is_height_raster(path, options)) return SourceKind::canopy;
  return options.kind == ThemeKind::Buildings ? SourceKind::buildings : SourceKind::walls;
}

/// What is the same for all files of an import.
struct FootprintImport {
  const ImportOptions& options;
  const StoreMetadata& store;
  VerticalDatums* datums;  ///< null where elevations need not share one
};

FootprintSource read_model(const std::string& path, const FootprintImport& import) {
  const ImportOptions& options = import.options;
  if (options.kind != ThemeKind::Buildings)
    throw InputError(path + ": CityJSON holds buildings; import it with `kind` buildings", "kind");
  CityJsonQuery query;
  query.path = path;
  query.crs = options.crs;
  query.ground_as_base = !options.base;
  query.memory_bytes = options.memory_bytes;
  query.kept = feature_query(options);
  query.datums = import.datums;
  return read_city_json(query, import.store.crs_wkt);
}

FootprintSource read_layer(const std::string& path, const FootprintImport& import, Progress& progress) {
  const ImportOptions& options = import.options;
  FootprintQuery query;
  query.path = path;
  query.layer = options.layer;
  query.where = options.where;
  query.height_field = options.height_field;
  query.eaves_field = options.eaves_field;
  query.base_field = options.base_field;
  query.kept = feature_query(options);
  query.crs = options.crs;
  if (options.height_from.empty()) query.height = options.height;
  query.storey = options.storey;
  query.kind = feature_kind(*options.kind);
  query.roof = options.roof.value_or(query.roof);
  query.thickness = options.thickness.value_or(query.thickness);
  query.datums = import.datums;
  return read_footprints(query, import.store.crs_wkt, import.store.grid, progress);
}

FootprintFile read_raster(const std::string& path, const FootprintImport& import, Progress& progress) {
  const ImportOptions& options = import.options;
  if (!is_raster(path)) {
    if (is_missing(path)) throw FileError(path, "there is no such file");
    throw InputError(path +
                         ": is no raster, as `kind` surface takes; import footprints with `kind` buildings, terraces, "
                         "walls or vegetation",
                     "kind");
  }
  HeightRasterQuery query;
  query.path = path;
  query.crs = options.crs;
  query.band = options.band;
  query.absolute = options.kind == ThemeKind::Surface;
  query.step = options.height_step.value_or(query.step);
  query.threshold = options.height_threshold.value_or(query.threshold);
  query.rounding = options.height_rounding.value_or(query.rounding);
  query.datums = import.datums;
  query.memory_bytes = options.memory_bytes;
  HeightRaster raster = read_height_raster(query, import.store, progress);
  FootprintFile file;
  file.footprints = std::move(raster.footprints);
  file.cells = raster.cells, file.voids = raster.voids, file.low_cells = raster.low;
  return file;
}

FootprintFile read_file(const std::string& path, SourceKind kind, const FootprintImport& import, Progress& progress) {
  if (kind == SourceKind::canopy || kind == SourceKind::surface) return read_raster(path, import, progress);
  FootprintFile file;
  file.footprints = kind == SourceKind::city_model ? read_model(path, import) : read_layer(path, import, progress);
  for (const FootprintFeature& feature : file.footprints.features) file.vertices += vertex_count(feature);
  return file;
}

bool has_height(const FootprintFeature& feature) {
  return feature.height || feature.eaves;
}

std::string why_empty(const std::vector<std::string>& warnings) {
  const auto passed_over = std::find_if(warnings.begin(), warnings.end(), [](const std::string& line) {
    return line.find("passed over") != std::string::npos;
  });
  return passed_over == warnings.end() ? "holds no features" : "holds no feature that could stand; " + *passed_over;
}

}  // namespace

bool builds_features(const ImportOptions& options) {
  if (options.kind == ThemeKind::Surface) return true;
  if (!options.kind || !may_be_raised(*options.kind)) return false;
  return options.height || !options.height_from.empty() || !options.height_field.empty() ||
         !options.eaves_field.empty() ||
         std::any_of(options.sources.begin(), options.sources.end(),
                     [&](const std::string& path) { return is_city_json(path) || is_height_raster(path, options); });
}

std::pair<double, double> height_error_of(const ImportOptions& options) {
  const double step = options.height_step.value_or(HeightRasterQuery{}.step);
  switch (options.height_rounding.value_or(HeightRounding::nearest)) {
    case HeightRounding::up:
      return {0, step};
    case HeightRounding::down:
      return {step, 0};
    default:
      return {step / 2, step / 2};
  }
}

std::vector<FootprintFile> read_footprint_files(const ImportOptions& options, const Store& store, Progress& progress) {
  if (options.height_percentile && options.height_from.empty())
    throw InputError("`height_percentile` works only with `height_from`", "height_percentile");
  std::vector<SourceKind> kinds;
  for (const std::string& path : options.sources) kinds.push_back(kind_of(path, options));
  require_useful_options(options, kinds);
  VerticalDatums datums(store.metadata());
  const FootprintImport import{options, store.metadata(), options.allow_mixed_vertical ? nullptr : &datums};
  std::optional<SurfaceHeights> surface;
  std::string raster_of_heights;
  if (!options.height_from.empty()) {
    surface.emplace(SurfaceHeightsQuery{options.height_from, options.height_percentile.value_or(50), import.datums,
                                        options.memory_bytes},
                    store, progress);
    raster_of_heights = name_and_checksum(options.height_from, file_sha256(options.height_from, progress));
  }
  std::vector<FootprintFile> files;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string& path = options.sources[i];
    FootprintFile& file = files.emplace_back(read_file(path, kinds[i], import, progress));
    if (file.footprints.features.empty()) throw FileError(path, why_empty(file.footprints.warnings));
    for (FootprintFeature& feature : file.footprints.features) {
      feature.base_rule = options.base.value_or(BaseRule::minimum);
      feature.flat_foundation = options.foundation == Foundation::flat;
    }
    if (surface) {
      const std::vector<FootprintFeature>& features = file.footprints.features;
      file.info.states_heights = std::any_of(features.begin(), features.end(), has_height);
      file.info.heights_from = raster_of_heights;
      surface->complete(file.footprints, progress);
    }
    for (FootprintFeature& feature : file.footprints.features)
      if (surface && !has_height(feature)) feature.height = options.height;
    file.info.path = path;
    file.info.kind = name_of(*options.kind);
    file.info.theme = options.theme;
    file.info.source_crs = file.footprints.crs;
    file.info.sha256 = path.starts_with("/vsi") ? std::string() : file_sha256(path, progress);
    file.info.imported = utc_now();
  }
  if (std::string warning = datums.warning(); !warning.empty())
    files.front().footprints.warnings.push_back(std::move(warning));
  return files;
}

}  // namespace itin
