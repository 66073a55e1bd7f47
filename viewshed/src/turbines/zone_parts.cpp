#include "turbines/zone_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>

#include "line/cell_tiles.hpp"
#include "line/hulls.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/partition.hpp"
#include "plan/point_counts.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

/// Returns a disc about the farm's middle that holds every turbine's reach.
Window::Polygon farm_disc(const std::vector<const Turbine*>& farm) {
  Box box;
  for (const Turbine* t : farm) box.extend(t->position);
  const Point2 middle = middle_of(box);
  double radius = 0;
  for (const Turbine* t : farm)
    radius = std::max(radius, std::hypot(t->position.x - middle.x, t->position.y - middle.y) + t->radius);
  return Window::disc(middle, radius).parts().front();
}

/// Returns a convex window about the radar, the other parts and all cells, so that it holds the radar's sight lines.
Window::Polygon box_with_radar(const std::vector<Window::Polygon>& parts, const ZoneRequest& request) {
  Box box = square_about(request.radar->position, 1);
  for (const Window::Polygon& part : parts)
    for (const Point2& p : part.outer) box.extend(p);
  if (request.grid) {
    const Box cells = request.grid->bounds();
    box.extend(Point2{cells.xmin, cells.ymin}), box.extend(Point2{cells.xmax, cells.ymax});
  }
  // Aligned cells end less than one cell beyond the other parts.
  const double beyond = request.cell_size.value_or(0);
  return Window::rectangle({box.xmin - beyond, box.ymin - beyond, box.xmax + beyond, box.ymax + beyond});
}

std::vector<Window::Polygon> farm_discs(const ZoneRequest& request) {
  std::map<std::string, std::vector<const Turbine*>> farms;
  for (const Turbine& t : request.turbines) farms[t.farm].push_back(&t);
  std::vector<Window::Polygon> discs;
  for (const auto& [name, farm] : farms) discs.push_back(farm_disc(farm));
  return discs;
}

std::vector<std::size_t> numbers_to(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// Bytes per triangle of one surface, and of two, as measured on OS Terrain 50.
constexpr double kBareGround = 160, kScreened = 270;

class Partition {
 public:
  Partition(const Store& store, const Zone& zone, const Box& box)
      : zone_(zone),
        margin_(2 * store.metadata().grid.resolution),
        tiles_(grid_of_tiles(zone.grid)),
        points_(store, level_within(store.metadata(), zone.request.detail.coarsest()), box) {}

  bool fits(const std::vector<Point2>& window, double bytes_per_triangle) const {
    return memory(window, bytes_per_triangle) <= static_cast<double>(*zone_.request.memory_bytes);
  }

  /// Divides the survey of the turbines from the cells in their reach.
  void divide_turbines(double bytes_per_triangle, std::vector<ZonePart>& parts) const {
    Box farm;
    for (const Turbine& t : zone_.request.turbines) farm.extend(t.position);
    std::vector<Box> boxes;
    std::vector<std::size_t> in_some_reach;
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i) {
      const Box& box = boxes.emplace_back(box_about(i));
      if (std::any_of(zone_.request.turbines.begin(), zone_.request.turbines.end(),
                      [&](const Turbine& t) { return in_reach(t, box); }))
        in_some_reach.push_back(i);
    }
    if (in_some_reach.empty()) return;
    sort_by_azimuth(
        middle_of(farm), [&](std::size_t i) { return middle_of(boxes[i]); }, in_some_reach);
    const auto window_over = [&](Numbers of) { return about_turbines_in_reach(boxes, of); };
    for (const Ground& ground : divide(in_some_reach, bytes_per_triangle, window_over))
      parts.push_back({window_of(ground), {ground.of.begin(), ground.of.end()}, {}, {}});
  }

  /// Divides the survey of the radar, over all cells and of all turbines.
  void divide_radar(std::vector<ZonePart>& parts) const {
    const Point2 radar = zone_.request.radar->position;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i) boxes.push_back(box_about(i));
    for (const Turbine& t : zone_.request.turbines) boxes.push_back(square_about(t.position, margin_));
    std::vector<std::size_t> all = numbers_to(boxes.size());
    sort_by_azimuth(
        radar, [&](std::size_t i) { return middle_of(boxes[i]); }, all);
    for (const Ground& ground : divide(all, kBareGround, [&](Numbers of) { return about_radar(boxes, of); })) {
      ZonePart& part = parts.emplace_back(ZonePart{window_of(ground), {}, {}, {}});
      for (const std::size_t i : ground.of) {
        if (i < tiles_.cell_count()) part.radar_tiles.push_back(i);
        if (i >= tiles_.cell_count()) part.radar_turbines.push_back(i - tiles_.cell_count());
      }
    }
  }

 private:
  using Numbers = std::span<const std::size_t>;
  struct Ground {
    Numbers of;
    std::vector<Point2> hull;  ///< holds all sight lines of the tiles and turbines in `of`
  };
  static Window window_of(const Ground& ground) { return Window::polygons({{ground.hull, {}}}); }

  double memory(const std::vector<Point2>& window, double bytes_per_triangle) const {
    const double triangles = 2 * static_cast<double>(points_.within(Window::polygons({{window, {}}})));
    return bytes_per_triangle * triangles + static_cast<double>(bytes_beside_surfaces(zone_));
  }

  /// Halves the numbers until the ground under each part fits.
  template <class HullOver>
  std::vector<Ground> divide(Numbers of, double bytes_per_triangle, const HullOver& hull_over) const {
    const auto ground = [](Numbers some) { return Ground{some, {}}; };
    return parts_that_fit(
        ground(of),
        [&](Ground& part) {
          part.hull = hull_over(part.of);
          return fits(part.hull, bytes_per_triangle);
        },
        [&](const Ground& part) {
          if (part.of.size() == 1) refuse(memory(part.hull, bytes_per_triangle));
          const auto [first, rest] = halves(part.of);
          return std::pair(ground(first), ground(rest));
        });
  }

  [[noreturn]] void refuse(double needed) const {
    throw InputError(
        fmt::format("this takes about {:.2g} GB of memory, more than the {:.2g} GB allowed: give a coarser "
                    "`tolerance`, a greater `cell_size`, a smaller `radius`, or more `memory_bytes`",
                    needed / 1e9, static_cast<double>(*zone_.request.memory_bytes) / 1e9));
  }

  Box box_about(std::size_t tile) const {
    const Box centres = box_of_centres(zone_.grid, tile_at(zone_.grid, tiles_, tile));
    return {centres.xmin - margin_, centres.ymin - margin_, centres.xmax + margin_, centres.ymax + margin_};
  }

  static bool in_reach(const Turbine& t, const Box& box) {
    return squared_distance(t.position, box) <= t.radius * t.radius;
  }

  std::vector<Point2> about_turbines_in_reach(const std::vector<Box>& boxes, Numbers of) const {
    std::vector<Point2> points;
    for (const std::size_t i : of) add_corners(boxes[i], points);
    for (const Turbine& t : zone_.request.turbines)
      if (std::any_of(of.begin(), of.end(), [&](std::size_t i) { return in_reach(t, boxes[i]); }))
        add_corners(square_about(t.position, margin_), points);
    return hull_of(std::move(points));
  }

  std::vector<Point2> about_radar(const std::vector<Box>& boxes, Numbers of) const {
    std::vector<Point2> points;
    for (const std::size_t i : of) add_corners(boxes[i], points);
    add_corners(square_about(zone_.request.radar->position, margin_), points);
    return hull_of(std::move(points));
  }

  const Zone& zone_;
  double margin_;  ///< metres, against rounding
  RasterGrid tiles_;
  PointCounts points_;
};

}  // namespace

Window window_of(const ZoneRequest& request) {
  std::vector<Window::Polygon> parts = farm_discs(request);
  if (request.radar) parts = {box_with_radar(parts, request)};
  return Window::polygons(std::move(parts));
}

ZonePart whole_zone(const Zone& zone) {
  ZonePart whole{window_of(zone.request), numbers_to(grid_of_tiles(zone.grid).cell_count()), {}, {}};
  if (!zone.request.radar) return whole;
  whole.radar_tiles = whole.tiles;
  whole.radar_turbines = numbers_to(zone.request.turbines.size());
  return whole;
}

std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened) {
  const ZonePart whole = whole_zone(zone);
  if (!zone.request.memory_bytes) return {whole};
  const Box box = whole.window.bounds();
  const Partition partition(store, zone, box);
  const double bytes_per_triangle = screened ? kScreened : kBareGround;
  std::vector<Point2> corners;
  add_corners(box, corners);
  if (partition.fits(hull_of(corners), bytes_per_triangle)) return {whole};
  std::vector<ZonePart> parts;
  partition.divide_turbines(bytes_per_triangle, parts);
  if (zone.request.radar) partition.divide_radar(parts);
  return parts;
}

}  // namespace itin::viewshed
