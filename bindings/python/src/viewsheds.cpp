// Viewsheds over a store, and over surfaces that are held for many of them.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/file_ending.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/output_file.hpp>
#include <itin/tin.hpp>
#include <profile/foliage_text.hpp>
#include <viewshed/foliage_view.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/viewshed.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"

namespace itin::python {

namespace {

using viewshed::Request;

/// A result, and what it was computed on: `metadata` is the store's, or that of an array, which has no store.
struct Viewshed {
  SharedStore store;
  std::shared_ptr<const StoreMetadata> metadata;
  viewshed::Result result;
  bool certified = false;
  /// What a viewshed through foliage tells, and how woods are seen through; empty where they are solid.
  viewshed::FoliageView foliage = {};
  std::string woods = {};
};

std::shared_ptr<Viewshed> viewshed_on(const SharedStore& store, viewshed::Result result, bool certified) {
  // The metadata live as long as the store.
  const std::shared_ptr<const StoreMetadata> metadata(store, &store->metadata());
  return std::make_shared<Viewshed>(Viewshed{store, metadata, std::move(result), certified});
}

std::optional<viewshed::AngleRange> angles_of(const py::dict& fields, const char* name) {
  if (!fields.contains(name)) return std::nullopt;
  const auto [from, to] = fields[name].cast<std::pair<double, double>>();
  return viewshed::AngleRange{from, to};
}

/// An observer is a dictionary of its fields.
viewshed::Observer observer_of(const py::dict& fields) {
  viewshed::Observer observer;
  take(fields, "name", observer.name);
  take(fields, "x", observer.position.x), take(fields, "y", observer.position.y);
  take(fields, "height", observer.height);
  take(fields, "absolute", observer.absolute);
  take(fields, "target_height", observer.target_height);
  take(fields, "radius", observer.radius);
  take(fields, "min_radius", observer.min_radius);
  observer.azimuth = angles_of(fields, "azimuth");
  observer.elevation = angles_of(fields, "elevation");
  observer.antenna = antenna_of(fields);
  return observer;
}

/// Reads `mode`, and what its modes take. "certified" asks for what is certain of kVisible.
bool take_mode(const py::dict& fields, Request& request) {
  std::string mode = "visible";
  take(fields, "mode", mode);
  if (mode == "certified") return true;
  const auto names = viewshed::mode_names();
  request.mode = static_cast<viewshed::Mode>(choice_of(mode, {names.begin(), names.end()}, "mode"));
  take(fields, "vertical_error", request.vertical_error.sigma);
  take(fields, "error_correlation", request.vertical_error.correlation_length);
  take(fields, "frequency_ghz", request.radio.frequency_ghz);
  take(fields, "over_sea", request.radio.over_sea);
  request.radio.polarisation = polarisation_of(fields);
  request.radio.effective_earth_km = effective_earth_km(request.earth);
  request.fresnel.wavelength = wavelength_m(request.radio.frequency_ghz);
  take(fields, "fresnel", request.fresnel.fraction);
  request.budget = budget_of(fields);
  take(fields, "margins_db", request.margins_db);
  return false;
}

/// Returns the request of a call, and whether what is certain is asked for.
std::pair<Request, bool> request_of(const py::dict& fields, const std::string& crs_wkt) {
  Request request;
  for (const py::handle observer : fields["observers"])
    request.observers.push_back(observer_of(observer.cast<py::dict>()));
  take(fields, "target_height", request.target_height);
  take(fields, "target_absolute", request.target_absolute);
  take(fields, "radius", request.radius);
  take(fields, "min_radius", request.min_radius);
  request.azimuth = angles_of(fields, "azimuth");
  request.elevation = angles_of(fields, "elevation");
  take(fields, "cell_size", request.cell_size);
  if (fields.contains("grid")) request.grid = grid_of(fields["grid"].cast<py::tuple>());
  request.earth = earth_of(fields, crs_wkt);
  request.detail = detail_of(fields);
  request.themes = themes_of(fields);
  take(fields, "observers_on_surface", request.observers_on_surface);
  take(fields, "targets_on_surface", request.targets_on_surface);
  request.nodata = nodata_of(fields);
  std::string engine = "auto";
  take(fields, "engine", engine);
  request.engine = static_cast<viewshed::Engine>(choice_of(engine, {"auto", "sweep", "rays"}, "engine"));
  const bool certified = take_mode(fields, request);
  return {std::move(request), certified};
}

std::shared_ptr<Viewshed> viewshed_of(const SharedStore& store, const py::dict& fields, const py::object& show) {
  auto [request, certified] = request_of(fields, store->metadata().crs_wkt);
  const LeftOut left_out(fields);
  const std::optional<profile::Foliage> foliage = foliage_of(fields);
  if (foliage && certified) throw InputError("`foliage`: only mode visible sees through woods", "foliage");
  viewshed::ComputeOptions options;
  options.whole_surface = false;
  take(fields, "memory_bytes", options.memory_bytes);
  viewshed::ThroughFoliage through =
      result_of(show, [&, &request = request, certified = certified](Progress& progress) -> viewshed::ThroughFoliage {
        left_out.leave(*store, request.themes, progress);
        if (foliage) return viewshed::compute_through_foliage(*store, request, *foliage, options, progress);
        return {certified ? viewshed::compute_certified(*store, request, options, progress)
                          : viewshed::compute_with_surface(*store, request, options, progress),
                {}};
      });
  const auto seen = viewshed_on(store, std::move(through.computed.result), certified);
  if (!foliage) return seen;
  seen->foliage = std::move(through.foliage);
  seen->woods = profile::foliage_rule_text(*foliage);
  return seen;
}

// A surface that is held.

struct Held {
  SharedStore store;
  viewshed::HeldSurface surface;
};

std::shared_ptr<Held> hold(const SharedStore& store, const py::tuple& area, const py::dict& fields,
                           const py::object& show) {
  const Box box{area[0].cast<double>(), area[1].cast<double>(), area[2].cast<double>(), area[3].cast<double>()};
  viewshed::ComputeOptions options;
  take(fields, "memory_bytes", options.memory_bytes);
  const Detail detail = detail_of(fields);
  const ThemeChoice themes = themes_of(fields);
  return result_of(show, [&](Progress& progress) {
    return std::make_shared<Held>(Held{store, viewshed::HeldSurface(*store, box, detail, themes, options, progress)});
  });
}

std::shared_ptr<Viewshed> viewshed_of_held(const Held& held, const py::dict& fields, const py::object& show) {
  const auto [request, certified] = request_of(fields, held.store->metadata().crs_wkt);
  if (certified) throw InputError("`mode`: what is held is decided exactly; give visible", "mode");
  auto result =
      result_of(show, [&, &request = request](Progress& progress) { return held.surface.compute(request, progress); });
  return viewshed_on(held.store, std::move(result), false);
}

// A surface through an array of heights.

struct Surface {
  Tin tin;
  std::shared_ptr<const StoreMetadata> metadata;
};

std::shared_ptr<Surface> surface_of_array(const py::array_t<float, py::array::c_style | py::array::forcecast>& heights,
                                          const py::tuple& grid, const std::string& crs, double resolution) {
  const std::span<const float> values(heights.data(), static_cast<std::size_t>(heights.size()));
  const RasterGrid posts = grid_of(grid);
  StoreMetadata metadata;
  metadata.crs_wkt = crs;
  metadata.levels.emplace_back();
  Tin tin = surface_through(posts, values, resolution);
  return std::make_shared<Surface>(Surface{std::move(tin), std::make_shared<const StoreMetadata>(std::move(metadata))});
}

std::shared_ptr<Viewshed> viewshed_of_surface(const Surface& surface, const py::dict& fields, const py::object& show) {
  const auto [request, certified] = request_of(fields, surface.metadata->crs_wkt);
  if (certified) throw InputError("`mode`: what is in memory is decided exactly; give visible", "mode");
  auto result = result_of(
      show, [&, &request = request](Progress& progress) { return viewshed::compute(surface.tin, request, progress); });
  return std::make_shared<Viewshed>(Viewshed{nullptr, surface.metadata, std::move(result), false});
}

// What a viewshed tells.

template <class Value>
void add(py::dict& values, const char* name, const std::vector<Value>& of_cells, const Shape& shape,
         const py::object& self) {
  if (!of_cells.empty()) values[name] = view_of(of_cells.data(), shape, self);
}

/// Views of the values of the mode, by name.
py::dict values_of(const py::object& self) {
  const auto& seen = self.cast<const Viewshed&>();
  const viewshed::Result& result = seen.result;
  const Shape shape = shape_of(result.grid);
  py::dict values;
  add(values, "foliage_m", seen.foliage.length_m, shape, self);
  add(values, "transmittance", seen.foliage.transmittance, shape, self);
  if (const auto* v = std::get_if<viewshed::Counts>(&result.values)) add(values, "count", v->count, shape, self);
  if (const auto* v = std::get_if<viewshed::ObserverSets>(&result.values)) {
    Shape banded = shape;
    banded.insert(banded.begin(), static_cast<py::ssize_t>(bit_grids(result.request.observers.size())));
    add(values, "words", v->words, banded, self);
  }
  if (const auto* v = std::get_if<viewshed::Angles>(&result.values))
    add(values, "angle_deg", v->angle_deg, shape, self);
  if (const auto* v = std::get_if<viewshed::NearestObservers>(&result.values)) {
    add(values, "number", v->number, shape, self);
    add(values, "distance_m", v->distance_m, shape, self);
  }
  if (const auto* v = std::get_if<viewshed::Blockers>(&result.values)) {
    add(values, "theme", v->theme, shape, self);
    add(values, "feature", v->feature, shape, self);
  }
  if (const auto* v = std::get_if<viewshed::LeastHeights>(&result.values))
    add(values, "height_m", v->height_m, shape, self);
  if (const auto* v = std::get_if<viewshed::Probabilities>(&result.values))
    add(values, "probability", v->probability, shape, self);
  if (const auto* v = std::get_if<viewshed::Levels>(&result.values)) {
    add(values, "level_dbm", v->level_dbm, shape, self);
    add(values, "outage_minutes", v->outage_minutes, shape, self);
    add(values, "observer", v->observer, shape, self);
  }
  if (const auto* v = std::get_if<viewshed::Losses>(&result.values)) {
    add(values, "diffraction_db", v->diffraction_db, shape, self);
    add(values, "free_space_db", v->free_space_db, shape, self);
  }
  return values;
}

py::array verdicts_of(const py::object& self) {
  const auto& result = self.cast<const Viewshed&>().result;
  return view_of(reinterpret_cast<const std::uint8_t*>(result.visible.data()), shape_of(result.grid), self);
}

py::dict cells_of(const Viewshed& v) {
  const viewshed::CellCounts& cells = v.result.cells;
  py::dict counts;
  counts["visible"] = cells.visible, counts["hidden"] = cells.hidden, counts["undecided"] = cells.undecided;
  counts["outside"] = cells.outside, counts["zone_cut"] = cells.zone_cut;
  return counts;
}

void write_viewshed(const Viewshed& v, const std::string& path, bool overwrite, const py::object& show) {
  const std::string ending = ending_of(path);
  const bool polygons = ending == ".gpkg" || ending == ".geojson";
  if (ending != ".tif" && ending != ".tiff" && !polygons)
    throw InputError("`path` '" + path + "': a viewshed is written as .tif, .gpkg or .geojson", "path");
  const StoreMetadata& metadata = *v.metadata;
  run(show, [&](Progress& progress) {
    if (polygons) {
      // Of an array it is not known which cells an observer looks at.
      const auto no_data =
          v.store ? viewshed::cells_without_ground(*v.store, v.result, progress) : std::vector<std::uint8_t>();
      return viewshed::write_polygons(path, v.result, metadata.crs_wkt, overwrite, no_data);
    }
    make_gdal_ready();
    const viewshed::ResultRasterOptions options{v.certified, overwrite, v.woods};
    if (!v.woods.empty())
      for (const std::string& beside : viewshed::foliage_rasters_beside(path))
        require_output_possible(beside, overwrite);
    viewshed::write_result_raster(path, v.result, metadata, options, progress);
    if (!v.woods.empty()) viewshed::write_foliage_rasters(path, v.result, v.foliage, metadata, options, progress);
  });
}

}  // namespace

void bind_viewsheds(py::module_& module) {
  py::class_<Viewshed, std::shared_ptr<Viewshed>>(module, "Viewshed")
      .def_property_readonly("verdict", &verdicts_of)
      .def_property_readonly("values", &values_of)
      .def_property_readonly("grid", [](const Viewshed& v) { return tuple_of(v.result.grid); })
      .def_property_readonly("crs_wkt", [](const Viewshed& v) { return v.metadata->crs_wkt; })
      .def_property_readonly("cells", &cells_of)
      .def_property_readonly("ground_m", [](const Viewshed& v) { return v.result.ground_m; })
      .def_property_readonly("warnings", [](const Viewshed& v) { return v.result.warnings; })
      .def_property_readonly("json", [](const Viewshed& v) { return viewshed::json_of(v.result, *v.metadata); })
      .def("write", &write_viewshed);
  py::class_<Held, std::shared_ptr<Held>>(module, "HeldSurface")
      .def_property_readonly("bytes", [](const Held& held) { return held.surface.bytes(); })
      .def("viewshed", &viewshed_of_held);
  py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface")
      .def(py::init(&surface_of_array))
      .def("viewshed", &viewshed_of_surface);
  store_class(module).def("viewshed", &viewshed_of).def("hold", &hold);
}

}  // namespace itin::python
