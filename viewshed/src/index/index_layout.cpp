#include "index/index_layout.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/grid_units.hpp>
#include <itin/silent_progress.hpp>
#include <viewshed/surface.hpp>

#include "index/ray_course.hpp"
#include "plan/memory.hpp"

namespace itin::viewshed {

namespace {

constexpr unsigned kRays = 128, kTargets = 128, kFewestRays = 8;

void require_valid_index(const IndexRequest& request) {
  const auto require = [](bool holds, const char* field, const char* what) {
    if (!holds) throw InputError(what, field);
  };
  require(std::isfinite(request.cell_size) && request.cell_size > 0, "cell_size",
          "the cell size must be positive, in metres");
  require(std::isfinite(request.radius) && request.radius > 0, "radius", "the radius must be positive, in metres");
  require(request.height >= 0, "height", "heights above the ground must not be negative");
  require(request.target_height >= 0, "target_height", "heights above the ground must not be negative");
  require(!request.targets || *request.targets > 0, "targets", "give at least one target for each observer");
  require(!request.rays || *request.rays >= kFewestRays, "rays", "give at least 8 rays for each observer");
  require(!request.rays || !request.targets, "rays", "observers have either `rays` or `targets`; give one of them");
}

/// How the centres of a row or a column of cells lie among posts.
struct AmongPosts {
  std::int64_t post = 0;
  double beyond = 0;  ///< grid units
};
AmongPosts among_posts(double units, std::int32_t spacing) {
  const double post = std::floor(units / spacing);
  return {static_cast<std::int64_t>(post), units - post * spacing};
}

/// Rays that have so many rings, or why there are none.
struct RaysOrNot {
  std::uint32_t rings = 0;
  std::string why_none;
};
RaysOrNot rays_or_not(const Store& store, const IndexRequest& request, const RasterGrid& grid, Progress& progress) {
  const auto posts = posts_under_index(store, request, grid, progress);
  if (!posts) return {0, "the surface is not that of the posts of one raster, at full detail"};
  const LatticeTin& lattice = posts->lattice();
  const double spacing = lattice.spacing * lattice.grid.resolution;
  if (!observers_among_posts(grid, lattice))
    return {0, fmt::format("cells of {:g} m are no multiple of the {:g} m between posts", request.cell_size, spacing)};
  const double rings = std::ceil(request.radius / spacing - 1e-9);
  if (rings > kMostRings)
    return {0, fmt::format("the radius is more than {} times the {:g} m between posts", kMostRings, spacing)};
  return {static_cast<std::uint32_t>(rings), {}};
}

}  // namespace

IndexLayout lay_out_index(const Store& store, const IndexRequest& request, Progress& progress) {
  require_valid_index(request);
  const RasterGrid grid =
      RasterGrid::aligned(request.area.is_all() ? extent_of(store) : request.area.bounds(), request.cell_size);
  require_memory_for_rasters(grid, kBytesPerIndexCell * grid.cell_count(), request.memory_bytes);
  if (request.targets) return {grid, {.targets = *request.targets}, 0};
  RaysOrNot found = rays_or_not(store, request, grid, progress);
  if (found.rings > 0) return {grid, {.rays = request.rays.value_or(kRays)}, found.rings};
  if (request.rays)
    throw InputError("there are no `rays`, for " + found.why_none + "; give `targets`, which lie at random", "rays");
  return {grid, {.targets = kTargets, .without_rays = std::move(found.why_none)}, 0};
}

std::optional<ObserverPosts> observers_among_posts(const RasterGrid& cells, const LatticeTin& lattice) {
  const double cell = cells.cell_width() / lattice.grid.resolution;
  const double step = std::round(cell / lattice.spacing);
  if (step < 1 || std::abs(step * lattice.spacing - cell) > 1e-4 * cell) return std::nullopt;
  const auto east_of = [&](std::int64_t column) {
    return among_posts(easting_in_units(lattice.grid, cells.centre_x(column)) - lattice.west, lattice.spacing);
  };
  const auto south_of = [&](std::int64_t row) {
    return among_posts(lattice.north - northing_in_units(lattice.grid, cells.centre_y(row)), lattice.spacing);
  };
  const AmongPosts west = east_of(0), north = south_of(0);
  // As far as the last cell, centres must not drift away from the posts.
  const auto keeps = [&](const AmongPosts& first, const AmongPosts& last, std::int64_t cells_between) {
    constexpr double kDrift = 1e-3;  // grid units
    return last.post - first.post == cells_between * static_cast<std::int64_t>(step) &&
           std::abs(last.beyond - first.beyond) < kDrift;
  };
  if (!keeps(west, east_of(cells.columns() - 1), cells.columns() - 1) ||
      !keeps(north, south_of(cells.rows() - 1), cells.rows() - 1))
    return std::nullopt;
  return ObserverPosts{west.post, north.post, static_cast<std::int64_t>(step), west.beyond / lattice.spacing,
                       north.beyond / lattice.spacing};
}

std::unique_ptr<LatticeReader> posts_under_index(const Store& store, const IndexRequest& request,
                                                 const RasterGrid& grid, Progress& progress) {
  const Box observers = grid.bounds();
  const double reach = request.radius + 2 * store.metadata().grid.resolution;
  SilentProgress silent(progress);
  auto surface = retrieve_lattice(
      store,
      Window::box({observers.xmin - reach, observers.ymin - reach, observers.xmax + reach, observers.ymax + reach}),
      request.detail, request.themes, LatticeReader::Heights::kNone, kAnyLattice, silent);
  return surface ? std::move(surface->lattice) : nullptr;
}

}  // namespace itin::viewshed
