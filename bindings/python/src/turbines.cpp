#include "turbines.hpp"

#include <cstdint>
#include <utility>

#include "arguments.hpp"

namespace itin::python {

namespace {

/// A turbine is a dictionary of its fields; the rule of radii gives a radius that is missing.
viewshed::Turbine turbine_of(const py::dict& fields, std::size_t number) {
  viewshed::Turbine turbine;
  turbine.number = number;
  take(fields, "name", turbine.name);
  take(fields, "farm", turbine.farm);
  take(fields, "x", turbine.position.x), take(fields, "y", turbine.position.y);
  viewshed::TurbineSize size;
  take(fields, "hub_height", size.hub);
  take(fields, "rotor_diameter", size.rotor);
  take(fields, "tip_height", size.tip);
  size.complete();
  turbine.hub_height = size.hub, turbine.rotor_diameter = size.rotor, turbine.tip_height = *size.tip;
  turbine.radius = viewshed::RadiusRule().radius(turbine.tip_height);
  take(fields, "radius", turbine.radius);
  return turbine;
}

viewshed::TurbineTable turbines_of_list(const py::list& list) {
  viewshed::TurbineTable table;
  for (const py::handle turbine : list)
    table.turbines.push_back(turbine_of(turbine.cast<py::dict>(), table.turbines.size() + 1));
  table.rows = table.turbines.size();
  for (std::size_t i = 0; i < table.rows; ++i) {
    table.features.push_back(static_cast<std::int64_t>(i));
    table.places.push_back("turbine " + std::to_string(i + 1));
  }
  return table;
}

}  // namespace

viewshed::TurbineTable turbines_of(const py::dict& fields, const std::string& crs_wkt, viewshed::TurbineFile file) {
  const py::object turbines = fields["turbines"];
  if (!py::isinstance<py::str>(turbines)) return turbines_of_list(turbines.cast<py::list>());
  file.path = turbines.cast<std::string>();
  take(fields, "turbine_crs", file.crs);
  take(fields, "radius", file.radius.fixed);
  if (file.radius.fixed) file.radius.source = "radius";
  return viewshed::read_turbines(file, crs_wkt);
}

}  // namespace itin::python
