// The parts of the module, each of which declares its classes and functions. The package `itin` wraps them in Python,
// with types, defaults and documentation.
#pragma once

#include <pybind11/pybind11.h>

namespace itin::python {

void bind_store(pybind11::module_& module);
void bind_import(pybind11::module_& module);
/// These add to the class Store, which bind_store() declares.
void bind_lines(pybind11::module_& module);
void bind_viewsheds(pybind11::module_& module);
void bind_site_plans(pybind11::module_& module);
void bind_zone_studies(pybind11::module_& module);
void bind_dwellings(pybind11::module_& module);

}  // namespace itin::python
