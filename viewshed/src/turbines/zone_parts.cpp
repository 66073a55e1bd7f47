#include "turbines/zone_parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>

#include "line/cell_tiles.hpp"
#include "line/hulls.hpp"
#include "plan/azimuth_order.hpp"
#include "plan/ground_runs.hpp"
#include "plan/ground_tiles.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

/// Returns a disc about the farm's middle that holds every turbine's reach.
Window::Polygon farm_disc(const std::vector<const Turbine*>& farm) {
  Box box;
  for (const Turbine* t : farm) box.extend(t->position);
  const Point2 middle = middle_of(box);
  double radius = 0;
  for (const Turbine* t : farm) radius = std::max(radius, distance(t->position, middle) + t->radius);
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

/// Returns a hull about the farm's turbines and all of the cells that they reach.
Window::Polygon farm_hull(const std::vector<const Turbine*>& farm, const Box& cells) {
  constexpr double kMetre = 1;
  Box reach;
  std::vector<Point2> corners;
  for (const Turbine* t : farm) {
    reach.extend(intersection(cells, square_about(t->position, t->radius)));
    add_corners(square_about(t->position, kMetre), corners);
  }
  if (!reach.empty()) add_corners(reach, corners);
  return {hull_of(std::move(corners)), {}};
}

std::vector<Window::Polygon> farm_windows(const ZoneRequest& request) {
  std::map<std::string, std::vector<const Turbine*>> farms;
  for (const Turbine& t : request.turbines) farms[t.farm].push_back(&t);
  std::vector<Window::Polygon> windows;
  for (const auto& [name, farm] : farms)
    windows.push_back(request.grid ? farm_hull(farm, request.grid->bounds()) : farm_disc(farm));
  return windows;
}

std::vector<std::size_t> numbers_to(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// Bytes per triangle of one surface, and of two, as measured on OS Terrain 50.
constexpr double kBareGround = 160, kScreened = 270;
/// About the number of points of a tile of the ground.
constexpr double kPointsPerGroundTile = 8;

double bytes_per_triangle(bool screened) {
  return screened ? kScreened : kBareGround;
}

/// The memory that a part with so many points of ground takes.
double memory_of(const Zone& zone, std::uint64_t points, double bytes_per_triangle) {
  return bytes_per_triangle * 2 * static_cast<double>(points) + static_cast<double>(bytes_beside_surfaces(zone));
}

class Partition {
 public:
  Partition(const Store& store, const Zone& zone, const Box& box)
      : zone_(zone),
        tiles_(grid_of_tiles(zone.grid)),
        ground_(store, level_within(store.metadata(), zone.request.detail.coarsest()), box, kPointsPerGroundTile) {}

  /// Divides the survey of the turbines from the cells in their reach.
  void divide_turbines(bool screened, std::vector<ZonePart>& parts) const {
    Box farm;
    for (const Turbine& t : zone_.request.turbines) farm.extend(t.position);
    const auto needed = ground_of(tiles_.cell_count(), [&](std::size_t tile, TileSet& ground) {
      const Box box = box_of_centres(zone_.grid, tile_at(zone_.grid, tiles_, tile));
      for (const Turbine& t : zone_.request.turbines)
        if (squared_distance(t.position, box) <= t.radius * t.radius) ground_.add_lines(t.position, box, ground);
    });
    for (GroundRun& run : divide(needed, middle_of(farm), bytes_per_triangle(screened)))
      parts.push_back({ground_.window(run.ground), std::move(run.pieces), {}, {}, ground_.points(run.ground)});
  }

  /// Divides the survey of the radar, over all cells and of all turbines.
  void divide_radar(std::vector<ZonePart>& parts) const {
    const Point2 radar = zone_.request.radar->position;
    const auto& turbines = zone_.request.turbines;
    const auto needed = ground_of(tiles_.cell_count() + turbines.size(), [&](std::size_t piece, TileSet& ground) {
      if (piece < tiles_.cell_count())
        ground_.add_lines(radar, box_of_centres(zone_.grid, tile_at(zone_.grid, tiles_, piece)), ground);
      else
        ground_.add_line(radar, turbines[piece - tiles_.cell_count()].position, ground);
    });
    for (const GroundRun& run : divide(needed, radar, bytes_per_triangle(false))) {
      ZonePart& part = parts.emplace_back(ZonePart{ground_.window(run.ground), {}, {}, {}, ground_.points(run.ground)});
      for (const std::size_t piece : run.pieces) {
        if (piece < tiles_.cell_count()) part.radar_tiles.push_back(piece);
        if (piece >= tiles_.cell_count()) part.radar_turbines.push_back(piece - tiles_.cell_count());
      }
    }
  }

 private:
  /// Returns the ground that each piece of work needs: add(piece, ground) adds it.
  template <class Add>
  std::vector<TileSet> ground_of(std::size_t pieces, const Add& add) const {
    std::vector<TileSet> needed(pieces, TileSet(ground_.count()));
    parallel_for(pieces, [&](std::size_t piece) { add(piece, needed[piece]); });
    return needed;
  }

  /// Returns runs of pieces that need ground, each next to the others as seen from a place.
  std::vector<GroundRun> divide(const std::vector<TileSet>& needed, Point2 about, double bytes_per_triangle) const {
    std::vector<std::size_t> order;
    for (std::size_t piece = 0; piece < needed.size(); ++piece)
      if (!needed[piece].empty()) order.push_back(piece);
    sort_by_azimuth(
        about, [&](std::size_t piece) { return middle_of_piece(piece); }, order);
    const auto memory = [&](const TileSet& ground) {
      return memory_of(zone_, ground_.points(ground), bytes_per_triangle);
    };
    const auto most = static_cast<double>(*zone_.request.memory_bytes);
    auto runs = ground_runs(
        order, ground_.count(), [&](std::size_t piece) -> const TileSet& { return needed[piece]; },
        [&](const TileSet& ground) { return memory(ground) <= most; });
    for (const GroundRun& run : runs)
      if (memory(run.ground) > most) refuse(memory(run.ground));
    return runs;
  }

  Point2 middle_of_piece(std::size_t piece) const {
    return piece < tiles_.cell_count() ? middle_of(box_of_centres(zone_.grid, tile_at(zone_.grid, tiles_, piece)))
                                       : zone_.request.turbines[piece - tiles_.cell_count()].position;
  }

  [[noreturn]] void refuse(double needed) const {
    throw InputError(
        fmt::format("this takes about {:.2g} GB of memory, more than the {:.2g} GB allowed: give a coarser "
                    "`tolerance`, a greater `cell_size`, a smaller `radius`, or more `memory_bytes`",
                    needed / 1e9, static_cast<double>(*zone_.request.memory_bytes) / 1e9),
        "memory_bytes");
  }

  const Zone& zone_;
  RasterGrid tiles_;
  GroundTiles ground_;
};

}  // namespace

Window window_of(const ZoneRequest& request) {
  std::vector<Window::Polygon> parts = farm_windows(request);
  if (request.radar) parts = {box_with_radar(parts, request)};
  return Window::polygons(std::move(parts));
}

ZonePart whole_zone(const Zone& zone) {
  ZonePart whole{window_of(zone.request), numbers_to(grid_of_tiles(zone.grid).cell_count()), {}, {}, 0};
  if (!zone.request.radar) return whole;
  whole.radar_tiles = whole.tiles;
  whole.radar_turbines = numbers_to(zone.request.turbines.size());
  return whole;
}

std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened) {
  ZonePart whole = whole_zone(zone);
  const Box box = whole.window.bounds();
  whole.points = store.points_about(level_within(store.metadata(), zone.request.detail.coarsest()), box);
  const auto& memory = zone.request.memory_bytes;
  if (!memory || memory_of(zone, whole.points, bytes_per_triangle(screened)) <= static_cast<double>(*memory))
    return {whole};
  const Partition partition(store, zone, box);
  std::vector<ZonePart> parts;
  partition.divide_turbines(screened, parts);
  if (zone.request.radar) partition.divide_radar(parts);
  return parts;
}

}  // namespace itin::viewshed
