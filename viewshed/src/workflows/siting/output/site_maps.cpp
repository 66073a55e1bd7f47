#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/filling_grid.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/hillshade.hpp"
#include "workflows/siting/output/site_map_objects.hpp"

namespace itin::viewshed {

namespace {

constexpr const char* kWithinRadius =
    "the area within the radius";  ///< what is looked at, in texts about missing ground

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

/// Tells what sites are chosen for.
std::string about_plan(const SitePlan& plan) {
  const SitePlanRequest& request = plan.request;
  const double kilometres = request.radius / 1000;
  if (request.turbines)
    return fmt::format("{} {:g} m above the ground, eyes {:g} m, within {:g} km",
                       request.turbines->minimised == Minimised::kHubs ? "Hubs" : "Blade tips",
                       request.turbines->minimised_height(), request.demand.height, kilometres);
  return fmt::format(
      "Radius {:g} km, targets {}{}{}", kilometres,
      plan.inputs.targets.heights.empty()
          ? fmt::format("{:g} m up", request.demand.height)
          : fmt::format("at heights of their own, cells of the map {:g} m up", request.demand.height),
      request.by_level() ? fmt::format(", {:g} dBm or more at {:g} GHz", request.least_dbm(), *request.frequency_ghz)
      : request.frequency_ghz ? fmt::format(", {:g} F1 clear at {:g} GHz", request.fresnel, *request.frequency_ghz)
                              : "",
      request.cover > 1 ? fmt::format(", by at least {} sites", request.cover) : "");
}

profile::TitleBlock title_of_plan(const Store& store, const SitePlan& r) {
  const SiteWording wording = wording_of(r.request);
  const bool turbines = r.request.turbines.has_value();
  profile::TitleBlock title;
  title.title = fmt::format("{} {}", wording.by, counted(r.choice.chosen.size(), wording.one));
  if (r.inputs.existing() > 0) title.title += fmt::format(" and {} existing", r.inputs.existing());
  title.statement = statement_of(store.metadata(), r.request.themes, Detail::tolerance(0));
  title.facts = {{turbines ? "Objective" : "Served", r.meaning()},
                 {turbines ? "Turbines" : "Targets", about_plan(r)},
                 {"Earth", r.request.earth.convention()}};
  return title;
}

std::string about_levels(const SitePlan& r) {
  return fmt::format("Radius {:g} km, receivers {:g} m up, {:g} GHz", r.request.radius / 1000, r.request.demand.height,
                     *r.request.frequency_ghz);
}

/// Returns the map of levels, which has the objects of the coverage's map.
ResultSheet level_sheet(const SitePlan& r, ResultSheet sheet) {
  sheet.heading = "Area within the radius";
  sheet.map = result_map(*r.levels, {});
  sheet.title.title =
      fmt::format("Level received from {}", counted(r.choice.chosen.size() + r.inputs.existing(), "site"));
  sheet.title.facts[1] = {"Receivers", about_levels(r)};
  return sheet;
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

std::uint64_t bytes_of_site_maps(const Store& store, const SitePlanRequest& request, const RasterGrid& grid) {
  // Bytes per cell: its nearest server, the distance to it, how many serve the cell, its level, margin, outage and
  // strongest server, and copies of these to draw and to write.
  constexpr std::uint64_t kCell = 24, kCellWithLevel = 56, kPoint = 150;
  return (request.by_level() ? kCellWithLevel : kCell) * grid.cell_count() +
         kPoint * store.points_about(hillshade_level(store, grid), grid.bounds());
}

std::vector<std::string> site_map_names(const SitePlanRequest& request) {
  if (request.by_level()) return {"coverage", "redundancy", "level"};
  return {"coverage", "redundancy"};
}

std::vector<SiteMap> site_maps(const Store& store, const SitePlan& r, Progress& progress) {
  Result result = plan_as_viewshed(r);
  const MissingGround missing = missing_ground(store, result, progress);
  const SiteWording wording = wording_of(r.request);
  ResultSheet sheet;
  sheet.grid = result.grid, sheet.area = shown_area(r);
  sheet.heading = "Demand, and area within the radius";
  sheet.studied = in_cells(result.grid, [&r](std::size_t cell) { return r.rasters.served[cell] != Verdict::kOutside; });
  sheet.objects = site_map_objects(store, r);
  sheet.missing = missing_on_sheet(places_without_ground(store, result, progress), missing, kWithinRadius);
  sheet.outside = "Beyond the radius, or no data";
  sheet.title = title_of_plan(store, r);
  MapOptions options;
  options.seen = wording.served, options.unseen = wording.unserved, options.shares = r.shares;
  const std::string about = about_plan(r);
  std::vector<SiteMap> maps{{"coverage", about, sheet}, {"redundancy", about, std::move(sheet)}};
  maps[0].sheet.map = result_map(result, options);
  result.request.mode = Mode::kCount;
  result.values = Counts{r.rasters.redundancy};
  options.counts = r.request.turbines ? "Turbines" : "Served by sites";
  maps[1].sheet.map = result_map(result, options);
  maps[1].sheet.title.title = wording.how_many;
  if (r.levels) maps.push_back({"level", about_levels(r), level_sheet(r, maps[0].sheet)});
  return maps;
}

std::vector<MapImage> drawn(const Store& store, const SitePlan& plan, const std::vector<SiteMap>& maps,
                            Progress& progress) {
  constexpr int kPixels = 1100;
  progress.report("maps", 0);
  const RasterGrid pixels = filling_grid(maps.front().sheet.area, kPixels);
  const MapBase base = plain_base(hillshade(pixels, heights_at(hillshade_surface(store, pixels, progress), pixels)));
  std::vector<MapImage> images(maps.size());
  parallel_for(maps.size(), [&](std::size_t i) { images[i] = draw_result_picture(base, maps[i].sheet, plan.crs_wkt); });
  return images;
}

}  // namespace itin::viewshed
