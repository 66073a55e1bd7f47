// Choices of sites.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/error.hpp>
#include <viewshed/site_plan.hpp>
#include <viewshed/zone_study.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"

namespace itin::python {

namespace {

struct Plan {
  SharedStore store;
  viewshed::SitePlan plan;
};

/// A place is a dictionary of its fields.
viewshed::SitePlace place_of(const py::dict& fields) {
  viewshed::SitePlace place;
  take(fields, "name", place.name);
  take(fields, "x", place.position.x), take(fields, "y", place.position.y);
  take(fields, "height", place.height);
  take(fields, "cost", place.cost);
  take(fields, "weight", place.weight);
  if (fields.contains("sectors")) {
    for (const py::handle item : fields["sectors"]) {
      const auto sector = item.cast<py::dict>();
      viewshed::SiteSector& added = place.sectors.emplace_back();
      take(sector, "name", added.name);
      added.antenna = antenna_of(sector);
    }
  }
  return place;
}

viewshed::SitePlaces places_of_list(const py::dict& fields, const char* name) {
  viewshed::SitePlaces places;
  if (!fields.contains(name)) return places;
  places.source = name;
  for (const py::handle place : fields[name]) places.places.push_back(place_of(place.cast<py::dict>()));
  return places;
}

viewshed::SiteDemand demand_of(const py::dict& fields) {
  viewshed::SiteDemand demand;
  if (fields.contains("demand")) demand.points = places_of_list(fields, "demand");
  if (fields.contains("demand_grid")) {
    demand.grid = grid_of(fields["demand_grid"].cast<py::tuple>());
    const auto weights = fields["demand_weights"].cast<Numbers>();
    demand.weights.assign(weights.data(), weights.data() + weights.size());
    demand.source = "demand";
  }
  take(fields, "target_height", demand.height);
  take(fields, "targets_on_surface", demand.on_surface);
  return demand;
}

std::vector<viewshed::Mast> masts_of(const py::dict& fields) {
  std::vector<viewshed::Mast> masts;
  for (const auto& [height, cost] : fields["masts"].cast<std::vector<std::pair<double, double>>>())
    masts.push_back({height, cost});
  return masts;
}

/// Turbines to place are a dictionary of their fields; two of their sizes imply the third.
viewshed::TurbinePlacement placement_of(const py::dict& fields) {
  viewshed::TurbinePlacement placement;
  viewshed::TurbineSize size;
  take(fields, "hub_height", size.hub);
  take(fields, "rotor_diameter", size.rotor);
  take(fields, "tip_height", size.tip);
  if (size.hub.has_value() + size.rotor.has_value() + size.tip.has_value() < 2)
    throw InputError("`turbines`: give two of hub_height, rotor_diameter and tip_height", "turbines");
  size.complete();
  placement.hub_height = *size.hub, placement.rotor_diameter = *size.rotor, placement.tip_height = *size.tip;
  if (!(placement.rotor_diameter > 0))
    throw InputError("`turbines`: the tip is no higher than the hub; give rotor_diameter", "turbines");
  std::string minimised = "tips";
  take(fields, "minimise", minimised);
  placement.minimised = static_cast<viewshed::Minimised>(choice_of(minimised, {"tips", "hubs", "height"}, "minimise"));
  if (fields.contains("spacing")) {
    const auto spacing = fields["spacing"].cast<std::array<double, 3>>();
    placement.spacing = viewshed::TurbineSpacing{spacing[0], spacing[1], spacing[2]};
  }
  if (fields.contains("dwellings")) {
    viewshed::SiteDwellings& dwellings = placement.dwellings.emplace();
    dwellings.source = "dwellings";
    dwellings.points = points_of(fields["dwellings"].cast<Numbers>(), "dwellings");
    take(fields, "setback", dwellings.setback);
  }
  take(fields, "farm", placement.farm);
  return placement;
}

viewshed::SitePlanRequest plan_request_of(const py::dict& fields, const Store& store) {
  viewshed::SitePlanRequest request;
  request.candidates = places_of_list(fields, "candidates");
  if (fields.contains("search_area")) request.search_area = fields["search_area"].cast<Window>();
  take(fields, "spacing", request.spacing);
  if (fields.contains("turbines"))
    request.turbines = placement_of(fields["turbines"].cast<py::dict>());
  else if (fields.contains("masts"))
    request.masts = masts_of(fields);
  take(fields, "on_surface", request.on_surface);
  if (fields.contains("forbidden")) request.forbidden = fields["forbidden"].cast<Window>();
  request.existing = places_of_list(fields, "existing");
  request.demand = demand_of(fields);
  take(fields, "radius", request.radius);
  take(fields, "cell_size", request.cell_size);
  take(fields, "frequency_ghz", request.frequency_ghz);
  take(fields, "fresnel", request.fresnel);
  request.link_budget = budget_of(fields);
  take(fields, "margin_db", request.margin_db);
  take(fields, "count", request.count);
  take(fields, "budget", request.budget);
  take(fields, "share", request.share);
  take(fields, "min_spacing", request.min_spacing);
  take(fields, "cover", request.cover);
  take(fields, "intervisible", request.intervisible);
  if (fields.contains("hub")) request.hub = place_of(fields["hub"].cast<py::dict>());
  request.earth = earth_of(fields, store.metadata().crs_wkt);
  request.themes = themes_of(fields);
  request.nodata = nodata_of(fields);
  take(fields, "memory_bytes", request.memory_bytes);
  return request;
}

std::shared_ptr<Plan> site(const SharedStore& store, const py::dict& fields, const py::object& show) {
  viewshed::SitePlanRequest request = plan_request_of(fields, *store);
  const LeftOut left_out(fields);
  auto plan = result_of(show, [&](Progress& progress) {
    left_out.leave(*store, request.themes, progress);
    return plan_sites(*store, std::move(request), progress);
  });
  return std::make_shared<Plan>(Plan{store, std::move(plan)});
}

/// Returns name, x, y, height, gain and cumulative value of each chosen site.
py::list chosen_of(const Plan& p) {
  py::list chosen;
  for (const viewshed::ChosenSite& site : p.plan.choice.chosen) {
    const viewshed::SitePosition& place = p.plan.place_of(site);
    chosen.append(py::make_tuple(place.name, place.position.x, place.position.y, place.height,
                                 p.plan.in_metric(site.gain), p.plan.in_metric(site.cumulative)));
  }
  return chosen;
}

py::dict rasters_of(const py::object& self) {
  const viewshed::SitePlan& plan = self.cast<const Plan&>().plan;
  const viewshed::SiteRasters& rasters = plan.rasters;
  const Shape shape = shape_of(rasters.grid);
  py::dict views;
  views["redundancy"] = view_of(rasters.redundancy.data(), shape, self);
  views["best_server"] = view_of(rasters.best_server.data(), shape, self);
  if (plan.levels) views["level_dbm"] = view_of(plan.levels->get<viewshed::Levels>().level_dbm.data(), shape, self);
  views["served"] = view_of(reinterpret_cast<const std::uint8_t*>(rasters.served.data()), shape, self);
  return views;
}

py::list write_plan(const Plan& p, const std::string& folder, bool overwrite, const py::object& show) {
  const auto written = result_of(show, [&](Progress& progress) {
    return write_site_plan(folder, p.plan, *p.store, progress, {.overwrite = overwrite});
  });
  py::list files;
  for (const viewshed::PlanFile& file : written) files.append(py::make_tuple(file.path, file.what));
  return files;
}

}  // namespace

void bind_site_plans(py::module_& module) {
  py::class_<Plan, std::shared_ptr<Plan>>(module, "SitePlan")
      .def_property_readonly("chosen", &chosen_of)
      .def_property_readonly("value", [](const Plan& p) { return p.plan.in_metric(p.plan.choice.value); })
      .def_property_readonly("upper_bound", [](const Plan& p) { return p.plan.in_metric(p.plan.choice.upper_bound); })
      .def_property_readonly("rasters", &rasters_of)
      .def_property_readonly("grid", [](const Plan& p) { return tuple_of(p.plan.rasters.grid); })
      .def_property_readonly("crs_wkt", [](const Plan& p) { return p.plan.crs_wkt; })
      .def_property_readonly("warnings", [](const Plan& p) { return p.plan.warnings; })
      .def_property_readonly("json", [](const Plan& p) { return json_of(p.plan, p.store->metadata()); })
      .def("write", &write_plan);
  store_class(module).def("site", &site);
}

}  // namespace itin::python
