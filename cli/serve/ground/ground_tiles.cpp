#include "serve/ground/ground_tiles.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include <itin/building_outlines.hpp>
#include <itin/document.hpp>
#include <itin/raster.hpp>
#include <itin/silent_progress.hpp>
#include <viewshed/relief.hpp>

#include "options/half_posting.hpp"

namespace itin::cli {

namespace {

static_assert(std::endian::native == std::endian::little, "tiles are little-endian");

/// The vertical tolerance of the ground in a picture, as a part of a pixel: relief of less is not seen.
constexpr double kToleranceOfPixel = 1.0 / 8;

double resolution_of(const TileGrid& grid, const TileAddress& tile) {
  return grid.resolutions[static_cast<std::size_t>(tile.zoom)];
}

double tolerance_of(const StoreMetadata& metadata, double resolution) {
  const double spacing = least_spacing(metadata).value_or(resolution);
  return resolution <= spacing ? 0 : kToleranceOfPixel * resolution;
}

/// Centimetres are less than a pixel.
double to_centimetres(double metres) {
  return std::round(100 * metres) / 100;
}

}  // namespace

std::optional<std::string> height_tile(const ServedStore& served, const TileGrid& grid, const TileAddress& tile,
                                       Progress& progress) {
  const std::optional<Box> box = grid.box(tile);
  if (!box) return std::nullopt;
  const double pixel = resolution_of(grid, tile);
  const int side = kTilePixels + 2 * kTileBorder;
  const RasterGrid pixels({box->xmin - kTileBorder * pixel, box->ymax + kTileBorder * pixel}, pixel, pixel, side, side);
  SilentProgress quiet(progress);
  const std::vector<float> heights =
      viewshed::ground_heights(served.store(), pixels, tolerance_of(served.metadata(), pixel), quiet);
  std::string bytes(heights.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), heights.data(), bytes.size());
  return bytes;
}

std::vector<std::string> outlined_themes(const StoreMetadata& metadata) {
  std::vector<std::string> names;
  for (const ThemeInfo& theme : metadata.themes)
    if (is_of_buildings(theme) && theme.is_raised()) names.push_back(theme.name);
  return names;
}

std::optional<std::string> outline_tile(const ServedStore& served, const TileGrid& grid, const TileAddress& tile,
                                        const std::string& theme) {
  const std::optional<Box> box = grid.box(tile);
  if (!box) return std::nullopt;
  const double pixel = resolution_of(grid, tile);
  Document rings = Document::array();
  const OutlineDetail detail{.tolerance = pixel / 10, .least = pixel};
  for (const auto& outline : building_outlines(served.store(), ThemeChoice::parse(theme), *box, detail)) {
    Document& ring = rings.emplace_back(Document::array());
    for (const Point2 p : outline) ring.push_back(to_centimetres(p.x)), ring.push_back(to_centimetres(p.y));
  }
  return json_text({{"rings", std::move(rings)}});
}

}  // namespace itin::cli
