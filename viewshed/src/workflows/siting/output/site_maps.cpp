#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

namespace itin::viewshed {

namespace {

constexpr int kPixelsOfPlan = 1100;

Result plan_as_viewshed(const SitePlan& r) {
  Result result;
  result.grid = r.rasters.grid;
  result.request.earth = r.request.earth;
  result.request.radius = r.request.radius;
  result.request.target_height = r.request.demand.height;
  // Where demand is a raster, only its cells count, whatever lies beyond within the radius.
  if (r.request.demand.grid) result.request.grid = r.rasters.grid;
  for (const ChosenSite& site : r.choice.chosen) {
    const SitePosition& place = r.place_of(site);
    result.request.observers.push_back({place.name, place.position, place.height});
  }
  result.visible = r.rasters.served;
  const auto count = [&](Verdict verdict) { return r.rasters.count(verdict); };
  using enum Verdict;
  result.cells = {count(kVisible), count(kHidden), count(kUndecided), count(kOutside)};
  return result;
}

/// Tells what the maps are for, in one line.
std::string subtitle_of_plan(const SitePlan& plan) {
  const SitePlanRequest& request = plan.request;
  const double kilometres = request.radius / 1000;
  if (request.turbines)
    return fmt::format("{} {:g} m above the ground, eyes {:g} m, within {:g} km",
                       request.turbines->minimised == Minimised::kHubs ? "Hubs" : "Blade tips",
                       request.turbines->minimised_height(), request.demand.height, kilometres);
  return fmt::format(
      "Radius {:g} km, targets {}{}{}", kilometres,
      plan.inputs.targets.heights.empty() ? fmt::format("{:g} m up", request.demand.height) : "at heights of their own",
      request.by_level() ? fmt::format(", {:g} dBm or more at {:g} GHz", request.least_dbm(), *request.frequency_ghz)
      : request.frequency_ghz ? fmt::format(", {:g} F1 clear at {:g} GHz", request.fresnel, *request.frequency_ghz)
                              : "",
      request.cover > 1 ? fmt::format(", by at least {} sites", request.cover) : "");
}

/// Returns the level whose hillshade lies under maps of these cells.
int hillshade_level(const Store& store, const RasterGrid& grid) {
  constexpr std::uint64_t kHillshadePoints = 400000;
  return finest_level_of(store, grid.bounds(), kHillshadePoints);
}

Tin hillshade_surface(const Store& store, const RasterGrid& grid, Progress& progress) {
  return triangulate(store, Window::box(grid.bounds()), detail_of(store.metadata(), hillshade_level(store, grid)),
                     progress);
}

}  // namespace

std::uint64_t bytes_of_site_maps(const Store& store, const RasterGrid& grid) {
  // Bytes per cell: its nearest server, the distance to it, how many serve the cell, and copies of these to draw and to
  // write.
  constexpr std::uint64_t kCell = 24, kPoint = 150;
  return kCell * grid.cell_count() + kPoint * store.points_about(hillshade_level(store, grid), grid.bounds());
}

std::vector<SiteMap> site_maps(const Store& store, const SitePlan& r, Progress& progress) {
  Result result = plan_as_viewshed(r);
  const MissingGround missing = missing_ground(store, result, progress);
  MapOptions options;
  options.no_data = cells_without_ground(store, result, progress);
  if (missing.without_ground > 0) options.no_data_text = missing.key_text(kWithinRadius);
  options.map_pixels = kPixelsOfPlan;
  options.crs_wkt = store.metadata().crs_wkt;
  const SiteWording wording = wording_of(r.request);
  options.seen = wording.served, options.unseen = wording.unserved, options.shares = r.shares;
  options.observers = wording.mark + (result.request.observers.size() == 1 ? "" : "s");
  options.outside = "Beyond the radius, or no data";
  options.title = fmt::format("{} {}", wording.by, counted(r.choice.chosen.size(), wording.one));
  if (r.inputs.existing() > 0) options.title += fmt::format(" and {} existing", r.inputs.existing());
  options.subtitle = subtitle_of_plan(r);
  options.dots = dots_of_points(r);
  std::vector<SiteMap> maps{{"coverage", result, options, missing}};
  result.request.mode = Mode::kCount;
  result.values = Counts{r.rasters.redundancy};
  options.title = wording.how_many;
  options.counts = r.request.turbines ? "Turbines" : "Served by sites";
  maps.push_back({"redundancy", std::move(result), std::move(options), missing});
  return maps;
}

std::vector<MapImage> drawn(const Store& store, const SitePlan& plan, const std::vector<SiteMap>& maps,
                            Progress& progress) {
  progress.report("maps", 0);
  const Tin tin = hillshade_surface(store, plan.rasters.grid, progress);
  std::vector<MapImage> images(maps.size());
  parallel_for(maps.size(), [&](std::size_t i) { images[i] = draw_map(tin, maps[i].result, maps[i].options); });
  return images;
}

}  // namespace itin::viewshed
