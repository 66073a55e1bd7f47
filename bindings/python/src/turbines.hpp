// Wind turbines, as calls give them.
#pragma once

#include <pybind11/pybind11.h>
#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::python {

/// Reads `turbines`: a list of dictionaries of their fields, or the path of a file, which `file` says how to read.
/// `turbine_crs` is the CRS of a file that states none, and `radius` that of all turbines of a file. Throws FileError,
/// InputError.
viewshed::TurbineTable turbines_of(const pybind11::dict& fields, const std::string& crs_wkt,
                                   viewshed::TurbineFile file = {});

}  // namespace itin::python
