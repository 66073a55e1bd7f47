// What a call asks for, from the plain values that the package hands over: dictionaries of fields, tuples, arrays.
//
// Requests of the libraries are filled from dictionaries whose keys are the names of their fields. Fields that are
// missing keep their defaults.
#pragma once

#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <profile/diffraction.hpp>
#include <profile/foliage.hpp>

namespace itin::python {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Takes a field of this name, if there is one.
template <class Value>
void take(const py::dict& fields, const char* name, Value& value) {
  if (fields.contains(name)) value = fields[name].cast<Value>();
}

/// Returns the rows of an array of shape (n, 2), or (n, 3). Throws InputError, which names the field, for another shape
/// and for numbers that are not finite.
std::vector<Point2> points_of(const Numbers& array, const char* field);
std::vector<Point3> places_of(const Numbers& array, const char* field);

/// Reads `tolerance`, or `rings` (a list of radius and tolerance) about a `centre`; and `themes`, which are "all" by
/// default.
Detail detail_of(const py::dict& fields);
ThemeChoice themes_of(const py::dict& fields);
/// The features that `without` names, which are left out of a choice of themes once the work has begun.
class LeftOut {
 public:
  explicit LeftOut(const py::dict& fields) { take(fields, "without", names_); }
  /// Leaves them out. Throws InputError for a name of no feature; CorruptStore, FileError, Cancelled.
  void leave(const Store& store, ThemeChoice& themes, Progress& progress) const;

 private:
  std::vector<std::string> names_;
};
/// Reads `foliage` (the extinction), `leaf_area` and `transmittance`; nothing without the first.
std::optional<profile::Foliage> foliage_of(const py::dict& fields);
/// Reads `earth`: (curvature, refraction, radius or None, effective factor or None). The radius is by default that of
/// the body of the CRS (WKT).
Earth earth_of(const py::dict& fields, const std::string& crs_wkt);
/// Reads `nodata`: "unknown", "block" or "clear".
NoData nodata_of(const py::dict& fields);
/// Reads `polarisation`: "h" by default, or "v".
Polarisation polarisation_of(const py::dict& fields);
/// Reads `antenna`, the file of a pattern, and `antenna_azimuth` and `antenna_tilt`, of an observer's own antenna.
profile::AimedAntenna antenna_of(const py::dict& fields);
/// Reads what a link budget needs, by the names of the options of `itin los`.
profile::BudgetQuery budget_of(const py::dict& fields);
/// Returns the index of a field's text among the choices. Throws InputError.
std::size_t choice_of(const std::string& text, const std::vector<std::string>& choices, const char* field);

/// A raster's cells as (west, north, cell width, cell height, columns, rows).
RasterGrid grid_of(const py::tuple& grid);
py::tuple tuple_of(const RasterGrid& grid);

}  // namespace itin::python
