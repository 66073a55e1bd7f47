#include "import/footprints/surface_heights.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/in_ring.hpp>
#include <itin/triangulate.hpp>

#include "import/footprints/height_raster.hpp"

namespace itin {

namespace {

constexpr double kMetresInMillimetre = 0.001;

/// The value below which `percentile` percent of the values lie, linear between neighbours in order.
double percentile_of(std::vector<double> values, double percentile) {
  std::ranges::sort(values);
  const double rank = percentile / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  if (below + 1 >= values.size()) return values.back();
  return std::lerp(values[below], values[below + 1], rank - static_cast<double>(below));
}

double base_of(const std::vector<double>& grounds, BaseRule rule) {
  switch (rule) {
    case BaseRule::minimum:
      return *std::ranges::min_element(grounds);
    case BaseRule::maximum:
      return *std::ranges::max_element(grounds);
    default:
      return std::accumulate(grounds.begin(), grounds.end(), 0.0) / static_cast<double>(grounds.size());
  }
}

/// The elevations of a feature's cells that have ground, and of that ground.
struct OverGround {
  std::vector<double> tops, grounds;
};

void give_height(const OverGround& cells, double percentile, FootprintFeature& feature) {
  if (feature.kind == FeatureKind::building) {
    const double base = feature.base ? *feature.base : base_of(cells.grounds, feature.base_rule);
    const double height = percentile_of(cells.tops, percentile) - base;
    if (height > 0) feature.base = base, feature.height = height;
    return;
  }
  std::vector<double> heights;
  for (std::size_t i = 0; i < cells.tops.size(); ++i) heights.push_back(cells.tops[i] - cells.grounds[i]);
  const double height = percentile_of(std::move(heights), percentile);
  if (height > 0) feature.height = height;
}

bool wants_height(const FootprintFeature& feature) {
  return !feature.height && !feature.eaves && feature.surfaces.empty() && !feature.cells;
}

/// "a.tif gives 12 of 14 features their heights, ...; 2 have none there: 'a', 'b'"
std::string told(const SurfaceHeightsQuery& query, std::size_t asked, const std::vector<std::string>& without) {
  constexpr std::size_t kMostNames = 5;
  std::string text = fmt::format("{}: gives {} of {} a height, the {:g}th percentile of its cells within each",
                                 query.path, asked - without.size(), counted(asked, "feature"), query.percentile);
  if (without.empty()) return text;
  const std::vector<std::string> named(
      without.begin(), without.begin() + static_cast<std::ptrdiff_t>(std::min(kMostNames, without.size())));
  return text + fmt::format("; {} without data or ground there, or no higher than the ground: {}{}", without.size(),
                            fmt::join(named, ", "), without.size() > kMostNames ? ", ..." : "");
}

}  // namespace

SurfaceHeights::SurfaceHeights(const SurfaceHeightsQuery& query, const Store& store, Progress& progress)
    : query_(query), store_(store) {
  if (!(query.percentile >= 0 && query.percentile <= 100))
    throw InputError(fmt::format("`height_percentile` {:g}: give 0 to 100; 50 is the median", query.percentile),
                     "height_percentile");
  HeightRasterQuery raster;
  raster.path = query.path;
  raster.absolute = true;
  raster.datums = query.datums;
  raster.memory_bytes = query.memory_bytes;
  HeightRaster read = read_height_raster(raster, store.metadata(), progress);
  warnings_ = std::move(read.footprints.warnings);
  lattice_ = *read.footprints.features.front().cells;
  lattice_.heights.clear(), lattice_.first_column = lattice_.first_row = 0;
  for (FootprintFeature& part : read.footprints.features) {
    const auto row = static_cast<std::size_t>(part.cells->first_row / kHeightPartSide);
    const auto column = static_cast<std::size_t>(part.cells->first_column / kHeightPartSide);
    if (parts_.size() <= row) parts_.resize(row + 1);
    if (parts_[row].size() <= column) parts_[row].resize(column + 1);
    parts_[row][column] = std::move(*part.cells);
  }
}

/// Calls visit(centre, elevation) for the cells with data that meet the box.
template <class Visit>
void SurfaceHeights::for_each_cell(const Box& box, const Visit& visit) const {
  const Point2 &across = lattice_.across, &down = lattice_.down;
  const double area = across.x * down.y - across.y * down.x;
  Box cells;  // in columns and rows
  for (const Point2 corner :
       {Point2{box.xmin, box.ymin}, {box.xmin, box.ymax}, {box.xmax, box.ymin}, {box.xmax, box.ymax}}) {
    const double dx = corner.x - lattice_.corner.x, dy = corner.y - lattice_.corner.y;
    cells.extend(Point2{(dx * down.y - dy * down.x) / area, (across.x * dy - across.y * dx) / area});
  }
  const auto clamped = [](double cell, std::size_t parts) {
    return static_cast<std::int64_t>(std::clamp(std::floor(cell), -1.0, static_cast<double>(parts * kHeightPartSide)));
  };
  for (std::int64_t row = std::max<std::int64_t>(0, clamped(cells.ymin, parts_.size()));
       row <= clamped(cells.ymax, parts_.size()); ++row) {
    const auto part_row = static_cast<std::size_t>(row / kHeightPartSide);
    if (part_row >= parts_.size()) break;
    const std::vector<HeightCells>& parts = parts_[part_row];
    for (std::int64_t column = std::max<std::int64_t>(0, clamped(cells.xmin, parts.size()));
         column <= clamped(cells.xmax, parts.size()); ++column) {
      const auto part_column = static_cast<std::size_t>(column / kHeightPartSide);
      if (part_column >= parts.size()) break;
      const HeightCells& part = parts[part_column];
      const std::int64_t c = column - part.first_column, r = row - part.first_row;
      if (part.heights.empty() || c >= part.columns || r >= part.rows) continue;
      const std::int32_t height = part.heights[static_cast<std::size_t>(r * part.columns + c)];
      if (height == kNoHeight) continue;
      visit(lattice_.corner_at(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5),
            height * kMetresInMillimetre);
    }
  }
}

std::vector<SurfaceHeights::Cell> SurfaceHeights::cells_of(const FootprintFeature& feature) const {
  std::vector<Cell> cells;
  for_each_cell(box_of_rings(feature.rings), [&](Point2 centre, double elevation) {
    if (in_rings(feature.rings, centre)) cells.push_back({centre, elevation});
  });
  if (!cells.empty()) return cells;
  for (const PlanRing& ring : feature.rings)
    for (const Point2& p : ring)
      for_each_cell({p.x, p.y, p.x, p.y}, [&](Point2, double elevation) { cells.push_back({p, elevation}); });
  return cells;
}

void SurfaceHeights::complete(FootprintSource& source, Progress& progress) const {
  std::vector<FootprintFeature*> features;
  std::vector<std::vector<Cell>> cells;
  std::vector<Point2> places;
  for (FootprintFeature& feature : source.features) {
    if (!wants_height(feature)) continue;
    features.push_back(&feature);
    cells.push_back(cells_of(feature));
    for (const Cell& cell : cells.back()) places.push_back(cell.centre);
    progress.throw_if_cancelled();
  }
  const auto grounds = heights_at(store_, places, Detail::tolerance(0), ThemeChoice::none(), progress);
  std::vector<std::string> without;
  std::size_t at = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    OverGround over;
    for (const Cell& cell : cells[i])
      if (const auto& ground = grounds[at++]) over.tops.push_back(cell.elevation), over.grounds.push_back(*ground);
    if (!over.tops.empty()) give_height(over, query_.percentile, *features[i]);
    if (!features[i]->height) without.push_back(features[i]->name);
  }
  source.warnings.insert(source.warnings.end(), warnings_.begin(), warnings_.end());
  if (!features.empty()) source.warnings.push_back(told(query_, features.size(), without));
}

}  // namespace itin
