#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <viewshed/area_text.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_parts.hpp>
#include <viewshed/surface.hpp>

#include "bounds/pixel_heights.hpp"
#include "request/cells_in_view.hpp"
#include "request/request.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

bool is_bounded(const Request& request) {
  return request.grid || all_bounded(request);
}

/// The box where observers look. A request that does not limit it asks about the box of all data: cells on the rim of
/// the raster, whose centres lie beyond that box, are there to fill the raster.
Box area_of(const Store& store, const Result& result) {
  return is_bounded(result.request) ? result.grid.bounds() : extent_of(store);
}

/// Calls found(place), on any thread, for cells of the area that are in view whatever their elevation, and outside in
/// the result. Returns the number of these cells.
template <class Found>
std::uint64_t for_each_outside(const Result& result, const Box& area, const Found& found) {
  return for_each_cell_in_view(
      result.request, result.grid,
      [&](RasterGrid::Cell place) {
        return result.visible[result.grid.index(place)] == Verdict::kOutside &&
               area.contains(result.grid.centre(place.column, place.row));
      },
      found);
}

/// Leaves only the cells without ground.
void leave_out_ground(const Tin& coverage, const RasterGrid& grid, std::vector<std::uint8_t>& cells) {
  const std::vector<float> heights = heights_at(coverage, grid);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!std::isnan(heights[i])) cells[i] = 0;
}

/// Marks the cells of a result, or of a part of one, where an observer looks within the area and there is no ground.
std::vector<std::uint8_t> marked_without_ground(const Store& store, const Result& result, const Box& area,
                                                Progress& progress) {
  const RasterGrid& grid = result.grid;
  std::vector<std::uint8_t> cells(grid.cell_count());
  for_each_outside(result, area, [&](RasterGrid::Cell place) { cells[grid.index(place)] = 1; });
  if (bounds_elevations(result.request) && std::find(cells.begin(), cells.end(), 1) != cells.end())
    leave_out_ground(coverage_of(store, Window::box(grid.bounds()), progress), grid, cells);
  return cells;
}

std::uint64_t count_without_ground(const Store& store, const Result& result, Progress& progress) {
  if (result.cells.outside == 0) return 0;
  const bool any_elevation = !bounds_elevations(result.request);
  const std::vector<MapView> views = views_of(result.request);
  const bool one_view_holds_all =
      std::any_of(views.begin(), views.end(), [&](const MapView& view) { return view.holds(result.grid.bounds()); });
  if (any_elevation && one_view_holds_all && is_bounded(result.request)) return result.cells.outside;
  const Box area = area_of(store, result);
  std::uint64_t count = 0;
  for_each_part(result, [&](const Result& part, RasterGrid::Cell) {
    if (any_elevation) {
      count += for_each_outside(part, area, [](RasterGrid::Cell) {});
    } else {
      const std::vector<std::uint8_t> cells = marked_without_ground(store, part, area, progress);
      count += static_cast<std::uint64_t>(std::count(cells.begin(), cells.end(), 1));
    }
  });
  return count;
}

}  // namespace

double MissingGround::share() const {
  const std::uint64_t missing = without_ground + beyond, all = missing + with_ground;
  return all == 0 ? 0 : static_cast<double>(missing) / static_cast<double>(all);
}

std::string MissingGround::percent() const {
  if (share() > 0 && share() < 0.001) return "less than 0.1 %";
  if (share() > 0.999 && share() < 1) return "more than 99.9 %";
  return fmt::format("{:.1f} %", 100 * share());
}

std::string MissingGround::text() const {
  return cell_area > 0 ? fmt::format("{} ({})", percent(), area_text(missing_m2())) : percent();
}

std::string MissingGround::key_text(const std::string& area) const {
  return fmt::format("No ground data: {} of {}", text(), area);
}

std::optional<std::string> MissingGround::warning(const std::string& area) const {
  if (share() < 0.001 || !bounded) return std::nullopt;
  return fmt::format(
      "{} of {} has no ground data: nothing is known of places there. `nodata` says what it does to sight lines that "
      "cross it; import a larger source, or, where it is the sea, import with `sea_level`, and beyond the sources with "
      "`sea_area`",
      text(), area);
}

std::vector<std::uint8_t> cells_without_ground(const Store& store, const Result& result, Progress& progress) {
  if (result.cells.outside == 0) return {};
  return marked_without_ground(store, result, area_of(store, result), progress);
}

bool PlacesWithoutGround::contain(Point2 place) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Cells& part) {
    const auto cell = part.values.empty() ? std::nullopt : part.grid.cell_at(place);
    return cell && part.values[part.grid.index(*cell)] == 1;
  });
}

PlacesWithoutGround places_without_ground(const Store& store, const Result& result, Progress& progress) {
  CellsBeyond beyond = cells_beyond(result.request, result.grid);
  return PlacesWithoutGround(
      {{result.grid, cells_without_ground(store, result, progress)}, {beyond.grid, std::move(beyond.cells)}});
}

MissingGround missing_ground(const Store& store, const Result& result, Progress& progress) {
  const Request& request = result.request;
  const RasterGrid& grid = result.grid;
  MissingGround missing;
  missing.cell_area = grid.cell_area();
  missing.without_ground = count_without_ground(store, result, progress);
  missing.with_ground = result.cells.in_view();
  missing.beyond = static_cast<std::uint64_t>(cells_beyond(request, grid).count());
  missing.bounded = is_bounded(request);
  return missing;
}

}  // namespace itin::viewshed
