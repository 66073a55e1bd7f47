#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include <itin/contour_lines.hpp>
#include <itin/map_picture.hpp>
#include <viewshed/map_base.hpp>
#include <viewshed/relief.hpp>

namespace itin::viewshed {

namespace {

constexpr std::int64_t kCoarser = 3;  ///< pixels along the side of a square, whose mean contours follow
constexpr Rgba kContour{150, 105, 60, 150};
constexpr float kNoElevation = std::numeric_limits<float>::quiet_NaN();

struct Heights {
  RasterGrid grid;
  std::vector<float> values;
};

/// Returns the means of squares of pixels; none for a square where a pixel has no height.
Heights smoothed(const Relief& ground) {
  const RasterGrid& fine = ground.pixels;
  const std::int64_t columns = std::max<std::int64_t>(1, fine.columns() / kCoarser),
                     rows = std::max<std::int64_t>(1, fine.rows() / kCoarser);
  Heights result{{fine.north_west(), kCoarser * fine.cell_width(), kCoarser * fine.cell_height(), columns, rows}, {}};
  result.values.assign(result.grid.cell_count(), kNoElevation);
  if (fine.columns() < kCoarser || fine.rows() < kCoarser) return result;
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      double sum = 0;
      for (std::int64_t i = 0; i < kCoarser * kCoarser; ++i)
        sum += ground.heights_m[fine.index({kCoarser * column + i % kCoarser, kCoarser * row + i / kCoarser})];
      result.values[result.grid.index({column, row})] = static_cast<float>(sum / (kCoarser * kCoarser));
    }
  return result;
}

/// The least interval usual on maps that draws at most about 16 lines between the lowest and the highest ground.
double contour_interval(double relief) {
  for (const double interval : {2.0, 5.0, 10.0, 20.0, 25.0, 50.0, 100.0})
    if (relief <= 16 * interval) return interval;
  return 200;
}

void add_contours(const Heights& heights, MapBase& base) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const float z : heights.values)
    if (!std::isnan(z)) low = std::min<double>(low, z), high = std::max<double>(high, z);
  if (!(high > low)) return;
  const double interval = contour_interval(high - low);
  profile::SheetLines plain{{}, kContour, 0.09, false}, index{{}, kContour, 0.2, false};
  constexpr std::size_t kWorthALabel = 60;
  for (auto k = static_cast<long>(std::ceil(low / interval)); static_cast<double>(k) * interval < high; ++k) {
    const bool fifth = k % 5 == 0;
    const double height = static_cast<double>(k) * interval;
    for (auto& points : contour_lines(heights.grid, heights.values, height)) {
      const std::string label = fifth && points.size() > kWorthALabel ? fmt::format("{:g}", height) : "";
      (fifth ? index : plain).lines.push_back({std::move(points), label});
    }
  }
  if (plain.lines.empty() && index.lines.empty()) return;
  base.contours = {std::move(plain), std::move(index)};
  base.keys.push_back({profile::SheetKey::Sample::kLine, {kContour}, fmt::format("Contours every {:g} m", interval)});
}

/// Shades the ground. Cells without ground are clear.
profile::SheetCells shaded(const Relief& ground) {
  constexpr double kLevelGrey = 226, kContrast = 90;
  profile::SheetCells cells{ground.pixels, std::vector<Rgba>(ground.pixels.cell_count(), kTransparent)};
  for (std::size_t i = 0; i < cells.colours.size(); ++i) {
    if (std::isnan(ground.shades[i])) continue;
    const double grey = kLevelGrey + kContrast * (ground.shades[i] - kLevelShade);
    const auto level = static_cast<std::uint8_t>(std::lround(std::clamp(grey, 120.0, 250.0)));
    cells.colours[i] = {level, level, level, 255};
  }
  return cells;
}

MapBase relief_base(const Store& store, const RasterGrid& pixels, Progress& progress) {
  const Relief ground = relief(store, pixels, progress);
  MapBase base = plain_base(ground);
  add_contours(smoothed(ground), base);
  return base;
}

MapBase picture_base(const std::string& basemap, const RasterGrid& pixels, const std::string& crs_wkt) {
  return {{pixels, picture_at(basemap, pixels, crs_wkt)}, {}, {}, {}};
}

}  // namespace

MapBase plain_base(const Relief& ground) {
  const bool has_holes =
      std::any_of(ground.shades.begin(), ground.shades.end(), [](double shade) { return std::isnan(shade); });
  return {shaded(ground), {}, {}, has_holes ? "No terrain data" : ""};
}

MapBase map_base(const Store& store, const Box& frame, double scale, const std::string& basemap, Progress& progress) {
  const double pixel = profile::kSheetPixelMm / 1000 * scale;
  const RasterGrid pixels({frame.xmin, frame.ymax}, pixel, pixel,
                          static_cast<std::int64_t>(std::ceil(frame.width() / pixel)),
                          static_cast<std::int64_t>(std::ceil(frame.height() / pixel)));
  return basemap.empty() ? relief_base(store, pixels, progress)
                         : picture_base(basemap, pixels, store.metadata().crs_wkt);
}

std::pair<std::string, std::string> basemap_fact(const std::string& basemap) {
  return {"Base map", std::filesystem::path(basemap).filename().string()};
}

std::vector<profile::SheetLayer> layers_of(const MapBase& base, profile::SheetCells shown) {
  std::vector<profile::SheetLayer> layers{base.picture, std::move(shown)};
  layers.insert(layers.end(), base.contours.begin(), base.contours.end());
  return layers;
}

}  // namespace itin::viewshed
