// Imports into stores.
#include <optional>
#include <string>

#include <itin/import.hpp>

#include "arguments.hpp"
#include "call.hpp"
#include "module.hpp"

namespace itin::python {

namespace {

/// Takes a field that a library's parse(text) understands.
template <class Value>
void take_named(const py::dict& fields, const char* name, std::optional<Value>& value,
                Value (*parse)(std::string_view)) {
  if (fields.contains(name)) value = parse(fields[name].cast<std::string>());
}

void take_standing(const py::dict& fields, ImportOptions& o) {
  take_named(fields, "kind", o.kind, &theme_kind);
  take(fields, "theme", o.theme);
  take(fields, "height_field", o.height_field);
  take(fields, "height_from", o.height_from);
  take(fields, "height_percentile", o.height_percentile);
  take(fields, "eaves_field", o.eaves_field);
  take(fields, "height", o.height);
  take(fields, "base_field", o.base_field);
  take_named(fields, "base", o.base, &base_rule);
  take_named(fields, "roof", o.roof, &roof_kind);
  take(fields, "storey", o.storey);
  take(fields, "thickness", o.thickness);
  take(fields, "wall_offset", o.wall_offset);
  take(fields, "height_step", o.height_step);
  take(fields, "height_threshold", o.height_threshold);
  take_named(fields, "height_rounding", o.height_rounding, &height_rounding);
  take(fields, "id_field", o.id_field);
  take(fields, "name_field", o.name_field);
  take(fields, "attributes", o.attributes);
  take(fields, "repair", o.repair);
  take(fields, "stay", o.stay);
  take(fields, "remove", o.remove);
}

ImportOptions options_of(const py::dict& fields) {
  ImportOptions o;
  take(fields, "sources", o.sources);
  take(fields, "crs", o.crs), take(fields, "to_crs", o.to_crs);
  take(fields, "z_field", o.z_field);
  take(fields, "layer", o.layer), take(fields, "where", o.where);
  take(fields, "band", o.band);
  take(fields, "classes", o.classes);
  take(fields, "max_gap", o.max_gap);
  take(fields, "allow_mixed_vertical", o.allow_mixed_vertical);
  take(fields, "source_note", o.source_note);
  take(fields, "sea_level", o.sea_level), take(fields, "sea_area", o.sea_area);
  take(fields, "replace", o.replace);
  take(fields, "tolerances", o.tolerances);
  take(fields, "resolution", o.resolution);
  take(fields, "memory_bytes", o.memory_bytes);
  take_standing(fields, o);
  return o;
}

py::tuple import_into(const std::string& store, const py::dict& fields, const py::object& show) {
  const ImportOptions options = options_of(fields);
  const ImportReport report = result_of(show, [&](Progress& progress) {
    return options.kind ? import_lines(store, options, progress) : import_terrain(store, options, progress);
  });
  return py::make_tuple(report.crs_name, report.vertices, report.features, report.refused, report.voids, report.seconds,
                        report.warnings);
}

}  // namespace

void bind_import(py::module_& module) {
  module.def("import_into", &import_into);
}

}  // namespace itin::python
