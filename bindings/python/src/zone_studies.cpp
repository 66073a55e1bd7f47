// Studies of wind farms.
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <viewshed/zone_study.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"
#include "turbines.hpp"

namespace itin::python {

namespace {

struct Study {
  SharedStore store;
  viewshed::ZoneStudy study;
};

viewshed::ViewpointTable viewpoints_of(const py::dict& fields, const Store& store) {
  viewshed::ViewpointTable table;
  if (!fields.contains("viewpoints")) return table;
  double height = 2;
  take(fields, "viewpoint_height", height);
  const py::object given = fields["viewpoints"];
  if (py::isinstance<py::str>(given))
    return viewshed::read_viewpoints({.path = given.cast<std::string>()}, store.metadata().crs_wkt, height);
  for (const py::handle place : given) {
    const auto one = place.cast<py::dict>();
    viewshed::Viewpoint viewpoint;
    viewpoint.number = ++table.rows, viewpoint.height = height;
    take(one, "name", viewpoint.name);
    take(one, "x", viewpoint.position.x), take(one, "y", viewpoint.position.y);
    take(one, "height", viewpoint.height);
    table.viewpoints.push_back(viewpoint);
    table.features.push_back(static_cast<std::int64_t>(table.rows) - 1);
    table.places.push_back("viewpoint " + std::to_string(table.rows));
  }
  return table;
}

viewshed::RouteTable routes_of(const py::dict& fields, const Store& store) {
  viewshed::RouteTable table;
  if (!fields.contains("routes")) return table;
  const py::object given = fields["routes"];
  if (py::isinstance<py::str>(given)) return viewshed::read_routes(given.cast<std::string>(), store.metadata().crs_wkt);
  for (const auto& [name, corners] : given.cast<std::vector<std::pair<std::string, Numbers>>>())
    table.routes.push_back({name, points_of(corners, "routes")});
  return table;
}

viewshed::ZoneStudyRequest study_request_of(const py::dict& fields, const Store& store) {
  viewshed::ZoneStudyRequest request;
  request.turbines = turbines_of(fields, store.metadata().crs_wkt);
  request.viewpoints = viewpoints_of(fields, store);
  request.routes = routes_of(fields, store);
  take(fields, "route_step", request.route_step);
  viewshed::ZoneRequest& zone = request.zone;
  if (fields.contains("radar")) {
    const auto radar = fields["radar"].cast<std::array<double, 3>>();
    zone.radar = viewshed::Observer{"radar", {radar[0], radar[1]}, radar[2]};
  }
  take(fields, "observer_height", zone.observer_height);
  take(fields, "cell_size", zone.cell_size);
  if (fields.contains("grid")) zone.grid = grid_of(fields["grid"].cast<py::tuple>());
  zone.earth = earth_of(fields, store.metadata().crs_wkt);
  zone.detail = detail_of(fields);
  zone.themes = themes_of(fields);
  zone.nodata = nodata_of(fields);
  if (const auto foliage = foliage_of(fields)) zone.foliage = {foliage->extinction, foliage->least_transmittance};
  take(fields, "memory_bytes", zone.memory_bytes);
  return request;
}

std::shared_ptr<Study> ztv(const SharedStore& store, const py::dict& fields, const py::object& show) {
  viewshed::ZoneStudyRequest request = study_request_of(fields, *store);
  const LeftOut left_out(fields);
  auto study = result_of(show, [&](Progress& progress) {
    left_out.leave(*store, *request.zone.themes, progress);
    return study_zone(*store, std::move(request), progress);
  });
  return std::make_shared<Study>(Study{store, std::move(study)});
}

/// Views of what is seen over bare ground or, where `screened`, past what stands on it; None where nothing does.
py::object visibility_of(const py::object& self, bool screened) {
  const viewshed::Zone& zone = self.cast<const Study&>().study.zone;
  if (screened && !zone.screened) return py::none();
  const viewshed::Visibility& v = screened ? *zone.screened : zone.bare;
  const Shape shape = shape_of(zone.grid);
  py::dict views;
  views["hub_count"] = view_of(v.hub_count.data(), shape, self);
  views["tip_count"] = view_of(v.tip_count.data(), shape, self);
  Shape banded = shape;
  banded.insert(banded.begin(), static_cast<py::ssize_t>(zone.words));
  views["turbines"] = view_of(v.turbines.data(), banded, self);
  const std::pair<const char*, const std::vector<float>*> numbers[] = {
      {"visible_height_m", &v.visible_height_m},
      {"vertical_angle_deg", &v.vertical_angle_deg},
      {"horizontal_angle_deg", &v.horizontal_angle_deg},
      {"share", &v.share},
      {"nearest_m", &v.nearest_m}};
  for (const auto& [name, values] : numbers) views[name] = view_of(values->data(), shape, self);
  return views;
}

/// Views of what is seen through woods in summer and in winter; None where they are solid.
py::object seasons_of(const py::object& self) {
  const viewshed::Zone& zone = self.cast<const Study&>().study.zone;
  if (!zone.seasons) return py::none();
  const Shape shape = shape_of(zone.grid);
  py::dict seasons;
  for (const auto& [name, counts] :
       {std::pair("summer", &zone.seasons->summer), std::pair("winter", &zone.seasons->winter)}) {
    py::dict views;
    views["hub_count"] = view_of(counts->hub_count.data(), shape, self);
    views["tip_count"] = view_of(counts->tip_count.data(), shape, self);
    seasons[name] = views;
  }
  return seasons;
}

/// A view of the least height above its ground that the radar sees in each cell; None without a radar.
py::object radar_of(const py::object& self) {
  const viewshed::Zone& zone = self.cast<const Study&>().study.zone;
  if (!zone.radar) return py::none();
  return view_of(zone.radar->height_m.data(), shape_of(zone.grid), self);
}

py::list write_study(const Study& s, const std::string& folder, bool overwrite, const py::object& show) {
  viewshed::ZoneStudyFileOptions options;
  options.overwrite = overwrite;
  const auto written = result_of(
      show, [&](Progress& progress) { return write_zone_study(folder, *s.store, s.study, options, progress); });
  py::list files;
  for (const viewshed::ZoneFile& file : written) files.append(py::make_tuple(file.name, file.what));
  return files;
}

}  // namespace

void bind_zone_studies(py::module_& module) {
  py::class_<Study, std::shared_ptr<Study>>(module, "ZoneStudy")
      .def("visibility", [](const py::object& self, bool screened) { return visibility_of(self, screened); })
      .def_property_readonly("seasons", &seasons_of)
      .def_property_readonly("radar_height_m", &radar_of)
      .def_property_readonly("grid", [](const Study& s) { return tuple_of(s.study.zone.grid); })
      .def_property_readonly("crs_wkt", [](const Study& s) { return s.study.metadata.crs_wkt; })
      .def_property_readonly("warnings", [](const Study& s) { return s.study.warnings; })
      .def_property_readonly("json", [](const Study& s) { return json_of(s.study); })
      .def("write", &write_study);
  store_class(module).def("ztv", &ztv);
}

}  // namespace itin::python
