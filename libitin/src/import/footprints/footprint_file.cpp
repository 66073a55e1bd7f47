#include "import/footprints/footprint_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_digest.hpp>

#include "import/footprints/city_json.hpp"
#include "import/points/scattered_source.hpp"
#include "import/source/source_options.hpp"

namespace itin {

namespace {

/// By its name, and a word that the format asks for near the beginning: members come in any order.
bool is_city_json(const std::string& path) {
  if (!path.ends_with(".json") && !path.ends_with(".cityjson")) return false;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(std::size_t{1} << 16, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return beginning.find("\"CityJSON\"") != std::string::npos || beginning.find("\"CityObjects\"") != std::string::npos;
}

FeatureKind feature_kind(ThemeKind kind) {
  if (kind == ThemeKind::Walls) return FeatureKind::wall;
  return kind == ThemeKind::Vegetation ? FeatureKind::vegetation : FeatureKind::building;
}

std::vector<SourceKind> kinds_of(const ImportOptions& options) {
  std::vector<SourceKind> kinds;
  for (const std::string& path : options.sources)
    kinds.push_back(is_city_json(path)                     ? SourceKind::city_model
                    : options.kind == ThemeKind::Buildings ? SourceKind::buildings
                                                           : SourceKind::walls);
  return kinds;
}

FootprintSource read_model(const std::string& path, const ImportOptions& options, const StoreMetadata& store) {
  if (options.kind != ThemeKind::Buildings)
    throw InputError(path + ": CityJSON holds buildings; import it with `kind` buildings");
  CityJsonQuery query;
  query.path = path;
  query.crs = options.crs;
  query.ground_as_base = !options.base;
  query.memory_bytes = options.memory_bytes;
  return read_city_json(query, store.crs_wkt);
}

FootprintSource read_layer(const std::string& path, const ImportOptions& options, const StoreMetadata& store,
                           Progress& progress) {
  FootprintQuery query;
  query.path = path;
  query.layer = options.layer;
  query.where = options.where;
  query.height_field = options.height_field;
  query.eaves_field = options.eaves_field;
  query.base_field = options.base_field;
  query.name_field = options.name_field;
  query.crs = options.crs;
  query.height = options.height;
  query.kind = feature_kind(*options.kind);
  query.roof = options.roof.value_or(query.roof);
  query.thickness = options.thickness.value_or(query.thickness);
  return read_footprints(query, store.crs_wkt, store.grid, progress);
}

std::string why_empty(const std::vector<std::string>& warnings) {
  const auto passed_over = std::find_if(warnings.begin(), warnings.end(), [](const std::string& line) {
    return line.find("passed over") != std::string::npos;
  });
  return passed_over == warnings.end() ? "holds no features" : "holds no feature that could stand; " + *passed_over;
}

}  // namespace

bool builds_features(const ImportOptions& options) {
  if (options.kind != ThemeKind::Buildings && options.kind != ThemeKind::Vegetation && options.kind != ThemeKind::Walls)
    return false;
  return options.height || !options.height_field.empty() || !options.eaves_field.empty() ||
         std::any_of(options.sources.begin(), options.sources.end(), is_city_json);
}

std::vector<FootprintFile> read_footprint_files(const ImportOptions& options, const StoreMetadata& store,
                                                Progress& progress) {
  require_useful_options(options, kinds_of(options));
  std::vector<FootprintFile> files;
  for (const std::string& path : options.sources) {
    FootprintFile& file = files.emplace_back();
    file.footprints =
        is_city_json(path) ? read_model(path, options, store) : read_layer(path, options, store, progress);
    if (file.footprints.features.empty()) throw FileError(path, why_empty(file.footprints.warnings));
    for (FootprintFeature& feature : file.footprints.features) {
      feature.base_rule = options.base.value_or(BaseRule::minimum);
      file.vertices += vertex_count(feature);
    }
    file.info.path = path;
    file.info.kind = name_of(*options.kind);
    file.info.theme = options.theme;
    file.info.source_crs = file.footprints.crs;
    file.info.sha256 = path.starts_with("/vsi") ? std::string() : file_sha256(path, progress);
    file.info.imported = utc_now();
  }
  return files;
}

}  // namespace itin
