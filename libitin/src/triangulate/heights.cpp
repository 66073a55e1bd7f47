#include "triangulate/heights.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>
#include <itin/raster.hpp>
#include <itin/silent_progress.hpp>
#include <itin/tin_heights.hpp>

#include "geometry/window_over.hpp"

namespace itin {

namespace {

/// Positions share a window if their box holds at most about this many points per position. triangulate() takes as many
/// at once, and the window then lists few leaves between the positions. A window takes about a kilobyte per position.
constexpr double kPointsPerPosition = 32768;
constexpr std::size_t kMostPositions = 16384;
/// At most this many places are looked up in every triangle near them.
constexpr std::size_t kFewPlaces = 4;

struct Place {
  Point2 units;       ///< on the grid
  std::size_t index;  ///< index of the position
};

/// Returns a box that all triangles that hold the position meet, whatever rounding does.
Box surroundings(Point2 p, const Grid& grid) {
  return square_about(p, 2 * grid.resolution);
}

/// Returns the positions that may have ground.
std::vector<Place> places_of(const StoreMetadata& metadata, const std::vector<Point2>& positions) {
  const Box data = metadata.grid.box(metadata.bounds);
  std::vector<Place> places;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Box about = surroundings(positions[i], metadata.grid);
    const bool near = about.xmax >= data.xmin && about.xmin <= data.xmax && about.ymax >= data.ymin &&
                      about.ymin <= data.ymax;  // false for NaN
    if (near) places.push_back({place_in_units(metadata.grid, positions[i]), i});
  }
  return places;
}

Box extent_of(std::span<const Place> places) {
  Box box;
  for (const Place& place : places) box.extend(place.units);
  return box;
}

/// Halves the places across the longer side of their box.
std::pair<std::span<Place>, std::span<Place>> divide_places(std::span<Place> places, const Box& box) {
  const std::size_t half = places.size() / 2;
  const bool wide = box.width() > box.height();
  std::nth_element(
      places.begin(), places.begin() + static_cast<std::ptrdiff_t>(half), places.end(),
      [&](const Place& a, const Place& b) { return wide ? a.units.x < b.units.x : a.units.y < b.units.y; });
  return {places.first(half), places.subspan(half)};
}

/// Adds the groups of places that share a window. `density`: the store's points per square unit.
void add_groups(std::span<Place> places, double density, std::vector<std::span<Place>>& groups) {
  const Box box = extent_of(places);
  const auto count = static_cast<double>(places.size());
  const bool near =
      places.size() <= kMostPositions && box.width() * box.height() * density <= kPointsPerPosition * count;
  if (places.size() < 2 || near) {
    groups.push_back(places);
    return;
  }
  const auto [one, other] = divide_places(places, box);
  add_groups(one, density, groups), add_groups(other, density, groups);
}

std::vector<std::span<Place>> groups_of(std::span<Place> places, const StoreMetadata& metadata) {
  const GridBox& all = metadata.bounds;
  const double width = std::max(1.0, static_cast<double>(all.xmax) - all.xmin),
               height = std::max(1.0, static_cast<double>(all.ymax) - all.ymin);
  std::vector<std::span<Place>> groups;
  if (!places.empty()) add_groups(places, static_cast<double>(metadata.vertices) / (width * height), groups);
  return groups;
}

Window window_about(std::span<const Place> places, const std::vector<Point2>& positions, const Grid& grid) {
  std::vector<Box> boxes;
  for (const Place& place : places) boxes.push_back(surroundings(positions[place.index], grid));
  return window_over(boxes);
}

/// Finds the heights of many places on one Tin: the places are halved again and again, and each half looks only at
/// triangles that meet its box, in the Tin's order.
class HeightsOn {
 public:
  HeightsOn(const Tin& tin, std::vector<std::optional<double>>& metres) : tin_(tin), metres_(metres) {}

  void find(std::span<Place> places) const {
    std::vector<std::uint32_t> all(tin_.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    find(places, all);
  }

 private:
  void find(std::span<Place> places, std::span<const std::uint32_t> triangles) const {
    const Box box = extent_of(places);
    std::vector<std::uint32_t> near;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(near),
                 [&](std::uint32_t t) { return meets(tin_.corners(t), box); });
    if (places.size() <= kFewPlaces) {
      for (const Place& place : places)
        if (const auto height = height_over(tin_, near, place.units))
          metres_[place.index] = *height * tin_.grid.resolution;
      return;
    }
    const auto [one, other] = divide_places(places, box);
    find(one, near), find(other, near);
  }

  static bool meets(const std::array<GridPoint, 3>& corners, const Box& box) {
    const auto [west, east] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [south, north] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    return west <= box.xmax && east >= box.xmin && south <= box.ymax && north >= box.ymin;
  }

  const Tin& tin_;
  std::vector<std::optional<double>>& metres_;
};

}  // namespace

RetrievedHeights retrieve_heights(const Store& store, const std::vector<Point2>& positions, const Detail& detail,
                                  const ThemeChoice& themes, Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  themes.check(metadata.themes);
  RetrievedHeights result{std::vector<std::optional<double>>(positions.size()), {}};
  std::vector<Place> places = places_of(metadata, positions);
  const std::vector<std::span<Place>> groups = groups_of(places, metadata);
  std::vector<RetrievalStatistics> statistics(groups.size());
  CallProgress call(progress);
  std::atomic<std::size_t> done = 0;
  parallel_for(groups.size(), [&](std::size_t i) {
    SilentProgress quiet(progress);
    const Tin tin = triangulate(store, window_about(groups[i], positions, metadata.grid), detail, quiet, themes);
    HeightsOn(tin, result.metres).find(groups[i]);
    statistics[i] = tin.statistics;
    call.report("heights", static_cast<double>(++done) / static_cast<double>(groups.size()));
  });
  for (const RetrievalStatistics& s : statistics) result.statistics += s;
  call.finish();
  return result;
}

std::vector<std::optional<double>> heights_at(const Store& store, const std::vector<Point2>& positions,
                                              const Detail& detail, const ThemeChoice& themes, Progress& progress) {
  return retrieve_heights(store, positions, detail, themes, progress).metres;
}

}  // namespace itin
