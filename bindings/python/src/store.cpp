// The class Store, and windows of it.
#include <string>
#include <utility>
#include <vector>

#include <itin/coordinates.hpp>
#include <itin/triangulate.hpp>
#include <itin/window.hpp>
#include <itin/window_source.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"

namespace itin::python {

namespace {

py::list levels_of(const Store& store) {
  py::list levels;
  for (const LevelInfo& level : store.metadata().levels)
    levels.append(py::make_tuple(level.tolerance, level.vertices, level.certified_error.lo, level.certified_error.hi));
  return levels;
}

py::list theme_list(const Store& store) {
  py::list themes;
  for (const ThemeInfo& theme : store.metadata().themes)
    themes.append(py::make_tuple(theme.name, std::string(name_of(theme.kind)), theme.features, theme.is_raised(),
                                 theme.left_out_count()));
  return themes;
}

py::tuple bounds_of(const Store& store) {
  const Box box = store.metadata().grid.box(store.metadata().bounds);
  return py::make_tuple(box.xmin, box.ymin, box.xmax, box.ymax);
}

py::array heights(const Store& store, const Numbers& xy, const py::dict& fields, const py::object& show) {
  const std::vector<Point2> points = points_of(xy, "xy");
  const Detail detail = detail_of(fields);
  const ThemeChoice themes = themes_of(fields);
  const auto found =
      result_of(show, [&](Progress& progress) { return heights_at(store, points, detail, themes, progress); });
  std::vector<double> metres;
  metres.reserve(found.size());
  for (const std::optional<double>& height : found) metres.push_back(height.value_or(std::nan("")));
  return array_of(std::move(metres));
}

py::array height_raster(const Store& store, const py::tuple& grid, const py::dict& fields, const py::object& show) {
  const RasterGrid cells = grid_of(grid);
  const Detail detail = detail_of(fields);
  const ThemeChoice themes = themes_of(fields);
  return array_of(
      result_of(show, [&](Progress& progress) { return heights_at(store, cells, detail, themes, progress); }),
      shape_of(cells));
}

/// Returns vertices (n, 3), triangles (m, 3), themes (m) and sources (n).
py::tuple arrays_of(Tin tin) {
  const auto vertices = static_cast<py::ssize_t>(tin.vertices.size());
  const auto triangles = static_cast<py::ssize_t>(tin.triangles.size());
  std::vector<double> positions;
  positions.reserve(3 * tin.vertices.size());
  for (std::uint32_t i = 0; i < tin.vertices.size(); ++i) {
    const Point3 p = tin.point(i);
    positions.insert(positions.end(), {p.x, p.y, p.z});
  }
  std::vector<std::uint32_t> corners;
  std::vector<std::uint16_t> themes;
  corners.reserve(3 * tin.triangles.size()), themes.reserve(tin.triangles.size());
  for (const Triangle& triangle : tin.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    themes.push_back(tin.theme(triangle));
  }
  return py::make_tuple(array_of(std::move(positions), {vertices, 3}), array_of(std::move(corners), {triangles, 3}),
                        array_of(std::move(themes)), array_of(std::move(tin.sources)));
}

py::tuple triangles_of(const Store& store, const Window& window, const py::dict& fields, const py::object& show) {
  const Detail detail = detail_of(fields);
  ThemeChoice themes = themes_of(fields);
  const LeftOut left_out(fields);
  return arrays_of(result_of(show, [&](Progress& progress) {
    left_out.leave(store, themes, progress);
    return triangulate(store, window, detail, progress, themes);
  }));
}

void bind_window(py::module_& module) {
  py::class_<Window>(module, "Window")
      .def_static("all", &Window::all)
      .def_static("box",
                  [](double xmin, double ymin, double xmax, double ymax) {
                    return Window::box({xmin, ymin, xmax, ymax});
                  })
      .def_static("disc",
                  [](double x, double y, double radius) {
                    return Window::disc({x, y}, radius);
                  })
      .def_static("wedge",
                  [](double x, double y, double azimuth, double width, double radius) {
                    return Window::wedge({x, y}, azimuth, width, radius);
                  })
      .def_static("corridor",
                  [](double x0, double y0, double x1, double y1, double width) {
                    return Window::corridor({x0, y0}, {x1, y1}, width);
                  })
      .def_static("polygon", &window_from_polygon);
}

}  // namespace

void bind_store(py::module_& module) {
  bind_window(module);
  StoreClass(module, "Store")
      .def(py::init([](const std::string& path, std::uint64_t cache_bytes) {
        const py::gil_scoped_release others_may_run;
        return std::make_shared<Store>(path, StoreOptions{cache_bytes});
      }))
      .def_property_readonly("path", &Store::path)
      .def_property_readonly("crs_wkt", [](const Store& store) { return store.metadata().crs_wkt; })
      .def_property_readonly("crs", [](const Store& store) { return crs_identifier(store.metadata().crs_wkt); })
      .def_property_readonly("resolution", [](const Store& store) { return store.metadata().grid.resolution; })
      .def_property_readonly("vertices", [](const Store& store) { return store.metadata().vertices; })
      .def_property_readonly("bounds", &bounds_of)
      .def_property_readonly("levels", &levels_of)
      .def_property_readonly("themes", &theme_list)
      .def("content_digest",
           [](const Store& store, const py::object& show) {
             return result_of(show, [&](Progress& progress) { return content_digest(store, progress); });
           })
      .def("heights", &heights)
      .def("height_raster", &height_raster)
      .def("triangulate", &triangles_of);
}

}  // namespace itin::python
