#include "viewshed/feature_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/triangulate.hpp>

#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"

namespace itin::cli {

namespace {

/// A Byte raster has no more numbers, and 255 means no data in those beside it.
constexpr std::size_t kMostThemes = 254;
/// Cells a side of what is triangulated at once.
constexpr std::int64_t kTile = 512;

/// Cells [first, end) of rows and columns.
struct CellRange {
  std::int64_t first_column, end_column, first_row, end_row;
};

Box bounds_of(const RasterGrid& grid, const CellRange& cells) {
  const Point2 first = grid.centre(cells.first_column, cells.first_row);
  const Point2 last = grid.centre(cells.end_column - 1, cells.end_row - 1);
  const double across = grid.cell_width() / 2, down = grid.cell_height() / 2;
  return {first.x - across, last.y - down, last.x + across, first.y + down};
}

/// The cells of a range whose centres may lie in a box.
CellRange cells_in(const RasterGrid& grid, const Box& box, const CellRange& range) {
  const auto cut = [](double v, std::int64_t low, std::int64_t high) {
    return static_cast<std::int64_t>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
  };
  return {cut(std::floor(grid.column_at(box.xmin) - 0.5), range.first_column, range.end_column),
          cut(std::ceil(grid.column_at(box.xmax) + 0.5), range.first_column, range.end_column),
          cut(std::floor(grid.row_at(box.ymax) - 0.5), range.first_row, range.end_row),
          cut(std::ceil(grid.row_at(box.ymin) + 0.5), range.first_row, range.end_row)};
}

bool holds(const std::array<Point3, 3>& triangle, Point2 p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0) return false;
  }
  return true;
}

void mark(const Tin& tin, const RasterGrid& grid, const CellRange& range, std::vector<std::uint8_t>& values) {
  for (const Triangle& t : tin.triangles) {
    const std::uint16_t theme = tin.theme(t);
    if (theme == 0) continue;
    const std::array<Point3, 3> corners{tin.point(t[0]), tin.point(t[1]), tin.point(t[2])};
    Box box;
    for (const Point3& p : corners) box.extend(Point2{p.x, p.y});
    const CellRange cells = cells_in(grid, box, range);
    for (std::int64_t row = cells.first_row; row < cells.end_row; ++row) {
      for (std::int64_t column = cells.first_column; column < cells.end_column; ++column) {
        if (!holds(corners, grid.centre(column, row))) continue;
        std::uint8_t& value = values[grid.index({column, row})];
        const auto number = static_cast<std::uint8_t>(theme);
        value = value == 0 ? number : std::min(value, number);
      }
    }
  }
}

std::vector<std::uint8_t> themes_under(const Store& store, const RasterGrid& grid,
                                       const FeatureRaster::Surface& surface, Progress& progress) {
  std::vector<std::uint8_t> values(grid.cell_count(), 0);
  NoProgress silent;
  for (std::int64_t row = 0; row < grid.rows(); row += kTile) {
    progress.report("features", static_cast<double>(row) / static_cast<double>(grid.rows()));
    for (std::int64_t column = 0; column < grid.columns(); column += kTile) {
      progress.throw_if_cancelled();
      const CellRange range{column, std::min(grid.columns(), column + kTile), row, std::min(grid.rows(), row + kTile)};
      const Box box = bounds_of(grid, range);
      if (store.greatest_feature_height(surface.themes, box) == 0) continue;
      mark(triangulate(store, Window::box(box), surface.detail, silent, surface.themes), grid, range, values);
    }
  }
  return values;
}

RasterClass class_of(int number, const std::string& name) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 4> kColours{
      {{184, 97, 84}, {97, 148, 87}, {133, 112, 173}, {217, 166, 64}}};
  const auto& [red, green, blue] = kColours[static_cast<std::size_t>(number - 1) % kColours.size()];
  return {number, name, red, green, blue, 255};
}

}  // namespace

void FeatureRaster::declare(CLI::App& app) {
  writes(app.add_option("--features", path_,
                        "Also write which of --themes is under each cell's centre, by number, 0 for none (.tif)")
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
  const std::vector<std::uint8_t> values = themes_under(store, grid, surface, progress);
  std::array<std::uint64_t, 256> cells{};
  for (const std::uint8_t value : values) ++cells[value];
  RasterDescription description;
  description.crs_wkt = metadata.crs_wkt;
  description.band_name = "theme of what stands there";
  description.overwrite = overwrite;
  description.classes = {{0, "none", 255, 255, 255, 0}};
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
  return found;
}

}  // namespace itin::cli
