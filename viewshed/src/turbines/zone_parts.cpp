#include "turbines/zone_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>

#include "line/cell_tiles.hpp"
#include "line/hulls.hpp"
#include "plan/point_counts.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// Of one farm: a disc about its middle that holds every turbine's reach.
Window::Polygon farm_disc(const std::vector<const Turbine*>& farm) {
  Box box;
  for (const Turbine* t : farm) box.extend(t->position);
  const Point2 middle{(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
  double radius = 0;
  for (const Turbine* t : farm)
    radius = std::max(radius, std::hypot(t->position.x - middle.x, t->position.y - middle.y) + t->radius);
  return Window::disc(middle, radius).parts().front();
}

/// Convex about the radar and all the rest, so that it holds the radar's sight lines.
Window::Polygon box_about(const std::vector<Window::Polygon>& parts, Point2 radar) {
  Box box;
  box.extend(Point2{radar.x - 1, radar.y - 1});
  box.extend(Point2{radar.x + 1, radar.y + 1});
  for (const Window::Polygon& part : parts)
    for (const Point2& p : part.outer) box.extend(p);
  return rectangle(box);
}

class Partition {
 public:
  Partition(const Store& store, const Zone& zone, bool screened, const Box& box)
      : zone_(zone),
        screened_(screened),
        margin_(2 * store.metadata().grid.resolution),
        tiles_(grid_of_tiles(zone.grid)),
        points_(store, level_within(store.metadata(), zone.request.detail.coarsest()), box) {}

  /// Bytes. As measured on OS Terrain 50: 160 a triangle of one surface, and another 110 of a second one; and what a
  /// cell's results take.
  double memory(const std::vector<Point2>& window) const {
    const double triangles = 2 * static_cast<double>(points_.within(Window::polygons({{window, {}}})));
    return (screened_ ? 270 : 160) * triangles + (screened_ ? 2 : 1) * static_cast<double>(bytes_of_results(zone_));
  }

  /// Those in reach of a turbine, from the south clockwise about the middle of all turbines.
  std::vector<std::size_t> tiles_by_azimuth() const {
    Box farm;
    for (const Turbine& t : zone_.request.turbines) farm.extend(t.position);
    const Point2 middle{(farm.xmin + farm.xmax) / 2, (farm.ymin + farm.ymax) / 2};
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i) {
      const Box box = box_about(i);
      if (std::none_of(zone_.request.turbines.begin(), zone_.request.turbines.end(),
                       [&](const Turbine& t) { return in_reach(t, box); }))
        continue;
      order.emplace_back(std::atan2((box.xmin + box.xmax) / 2 - middle.x, (box.ymin + box.ymax) / 2 - middle.y), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> result;
    for (const auto& [azimuth, tile] : order) result.push_back(tile);
    return result;
  }

  /// Cuts them in halves until each part fits.
  void divide(std::span<const std::size_t> tiles, std::vector<ZonePart>& parts) const {
    const std::vector<Point2> window = window_over(tiles);
    const double needed = memory(window);
    if (needed <= static_cast<double>(*zone_.request.memory_bytes)) {
      parts.push_back({Window::polygons({{window, {}}}), {tiles.begin(), tiles.end()}});
    } else if (tiles.size() > 1) {
      divide(tiles.first(tiles.size() / 2), parts);
      divide(tiles.subspan(tiles.size() / 2), parts);
    } else {
      refuse(needed);
    }
  }

  [[noreturn]] void refuse(double needed) const {
    throw InputError(
        fmt::format("this takes about {:.2g} GB of memory, more than the {:.2g} GB allowed: give a coarser "
                    "tolerance, larger cells or a smaller radius, or allow more",
                    needed / 1e9, static_cast<double>(*zone_.request.memory_bytes) / 1e9));
  }

 private:
  Box box_about(std::size_t tile) const {
    const Box centres = box_of_centres(zone_.grid, tile_at(zone_.grid, tiles_, tile));
    return {centres.xmin - margin_, centres.ymin - margin_, centres.xmax + margin_, centres.ymax + margin_};
  }

  static bool in_reach(const Turbine& t, const Box& box) {
    return squared_distance(t.position, box) <= t.radius * t.radius;
  }

  /// Convex about the tiles' cells and all turbines in their reach.
  std::vector<Point2> window_over(std::span<const std::size_t> tiles) const {
    std::vector<Point2> points;
    std::vector<bool> met(zone_.request.turbines.size());
    for (const std::size_t tile : tiles) {
      const Box box = box_about(tile);
      add_corners(box, points);
      for (std::size_t k = 0; k < met.size(); ++k) met[k] = met[k] || in_reach(zone_.request.turbines[k], box);
    }
    for (std::size_t k = 0; k < met.size(); ++k) {
      const Point2 p = zone_.request.turbines[k].position;
      if (met[k]) add_corners(disc_box(p, margin_), points);
    }
    return hull_of(std::move(points));
  }

  const Zone& zone_;
  bool screened_;
  double margin_;  ///< metres, against rounding
  RasterGrid tiles_;
  PointCounts points_;
};

}  // namespace

Window window_of(const ZoneRequest& request) {
  std::map<std::string, std::vector<const Turbine*>> farms;
  for (const Turbine& t : request.turbines) farms[t.farm].push_back(&t);
  std::vector<Window::Polygon> parts;
  for (const auto& [name, farm] : farms) parts.push_back(farm_disc(farm));
  if (request.radar) parts.push_back(box_about(parts, request.radar->position));
  return Window::polygons(std::move(parts));
}

ZonePart whole_zone(const Zone& zone) {
  ZonePart whole{window_of(zone.request), std::vector<std::size_t>(grid_of_tiles(zone.grid).cell_count())};
  std::iota(whole.tiles.begin(), whole.tiles.end(), std::size_t{0});
  return whole;
}

std::uint64_t bytes_of_results(const Zone& zone) {
  return (36 + 4 * zone.words) * zone.grid.cell_count();
}

std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened) {
  const ZonePart whole = whole_zone(zone);
  if (!zone.request.memory_bytes) return {whole};
  const Box box = whole.window.bounds();
  const Partition partition(store, zone, screened, box);
  std::vector<Point2> corners;
  add_corners(box, corners);
  const double needed = partition.memory(hull_of(corners));
  if (needed <= static_cast<double>(*zone.request.memory_bytes)) return {whole};
  // A radar's heights are surveyed all at once.
  if (zone.request.radar) partition.refuse(needed);
  std::vector<ZonePart> parts;
  partition.divide(partition.tiles_by_azimuth(), parts);
  return parts;
}

}  // namespace itin::viewshed
