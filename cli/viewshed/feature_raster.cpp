#include "viewshed/feature_raster.hpp"

#include <array>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/theme_raster.hpp>

#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

namespace {

/// A Byte raster has no more numbers, for 255 means no data in the rasters beside it.
constexpr std::size_t kMostThemes = 254;

RasterClass class_of(int number, const std::string& name) {
  static constexpr std::array<Rgba, 4> kColours{{{184, 97, 84}, {97, 148, 87}, {133, 112, 173}, {217, 166, 64}}};
  return {number, name, kColours[static_cast<std::size_t>(number - 1) % kColours.size()]};
}

}  // namespace

void FeatureRaster::declare(CLI::App& app) {
  begin_group(app, kOutputs);
  writes(
      app.add_option("--features", path_,
                     "Also write which of --themes is under each cell's centre, by number, 0 for none (.tif), with a "
                     "QGIS style beside it (.qml)")
          ->type_name("FILE"));
}

void FeatureRaster::validate() const {
  if (!path_.empty() && !names_geotiff(path_))
    throw InputError(fmt::format("--features '{}': a raster is written as .tif", path_));
}

std::vector<std::string> FeatureRaster::paths() const {
  return path_.empty() ? std::vector<std::string>() : std::vector{path_};
}

void FeatureRaster::require_themes(const StoreMetadata& metadata, const ThemeChoice& themes) const {
  if (path_.empty()) return;
  if (!themes.includes_raised(metadata.themes))
    throw InputError("--features: none of the chosen themes stands on the ground; name some by --themes");
  if (metadata.themes.size() > kMostThemes)
    throw InputError(fmt::format("--features: the store has {} themes, and a byte counts to {}", metadata.themes.size(),
                                 kMostThemes));
}

Document FeatureRaster::write(const Store& store, const RasterGrid& grid, const Surface& surface, bool overwrite,
                              Progress& progress) const {
  if (path_.empty()) return Document();
  const StoreMetadata& metadata = store.metadata();
  const std::vector<std::uint8_t> values =
      viewshed::theme_raster(store, grid, surface.detail, surface.themes, progress);
  std::array<std::uint64_t, 256> cells{};
  for (const std::uint8_t value : values) ++cells[value];
  RasterDescription description;
  description.crs_wkt = metadata.crs_wkt;
  description.band_name = "theme of what stands there";
  description.overwrite = overwrite;
  description.classes = {{0, "none", {255, 255, 255, 0}}};
  description.metadata = {{"itin", ITIN_VERSION},
                          {"surface", json_text(surface_document(metadata, surface.detail, surface.themes))}};
  Document found = Document::array();
  for (std::size_t i = 0; i < metadata.themes.size(); ++i) {
    const ThemeInfo& theme = metadata.themes[i];
    if (!theme.is_raised() || !surface.themes.includes(theme)) continue;
    const int number = static_cast<int>(i) + 1;
    description.classes.push_back(class_of(number, theme.name));
    description.metadata.emplace_back("cells " + theme.name, fmt::format("{}", cells[i + 1]));
    found.push_back({{"number", number}, {"theme", theme.name}, {"cells", cells[i + 1]}});
  }
  write_raster(path_, grid, std::span<const std::uint8_t>(values), description);
  write_file(viewshed::style_beside(path_), viewshed::qgis_style(description.classes), overwrite);
  return found;
}

}  // namespace itin::cli
