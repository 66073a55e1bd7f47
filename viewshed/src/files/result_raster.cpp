#include <array>

#include <itin/document.hpp>
#include <itin/output_file.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/result_raster.hpp>

namespace itin::viewshed {

namespace {

/// In the order of Mode.
constexpr std::array<std::string_view, 11> kModeNames{
    "visible", "count", "which", "angle", "nearest", "blocker", "height", "probability", "fresnel", "loss", "level"};

const char* standing_on(bool surface) {
  return surface ? "surface" : "ground";
}

}  // namespace

std::span<const std::string_view> mode_names() {
  return kModeNames;
}

std::span<const std::string_view> modes_of_sight() {
  return mode_names().first(static_cast<std::size_t>(Mode::kFresnel));
}

std::string mode_name(Mode mode, bool certified) {
  return std::string(certified ? "certified" : kModeNames[static_cast<std::size_t>(mode)]);
}

void write_result_raster(const std::string& path, const Result& result, const StoreMetadata& metadata,
                         const ResultRasterOptions& options, const Progress& progress) {
  const Request& r = result.request;
  const bool precise = !options.certified && r.detail.coarsest() == 0;
  GeotiffOptions file{metadata.crs_wkt,
                      {{"itin", ITIN_VERSION},
                       {"surface", json_text(surface_document(metadata, r.detail, r.themes))},
                       {"mode", mode_name(r.mode, options.certified)},
                       {"precise", precise ? "yes" : "no"},
                       {"observer_on", standing_on(r.observers_on_surface)},
                       {"target_on", standing_on(r.targets_on_surface)}},
                      options.overwrite};
  if (!options.foliage.empty()) file.metadata.emplace_back("foliage", options.foliage);
  const bool styled = has_qgis_style(r.mode);
  require_output_possible(path, options.overwrite);
  if (styled) require_output_possible(style_beside(path), options.overwrite);
  write_geotiff(path, result, file, progress);
  if (styled) write_file(style_beside(path), qgis_style(result), options.overwrite);
}

}  // namespace itin::viewshed
