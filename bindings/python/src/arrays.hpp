// Results as NumPy arrays: views of what a result holds, and arrays that own their values.
#pragma once

#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <utility>
#include <vector>

#include <itin/raster.hpp>

namespace itin::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

/// Returns an array of values that `owner` holds, which lives as long as the array. It cannot be written to.
template <class Value>
py::array view_of(const Value* values, Shape shape, const py::handle& owner) {
  py::array_t<Value> view(std::move(shape), values, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// Returns an array of values that it owns, without a copy.
template <class Value>
py::array array_of(std::vector<Value> values, Shape shape) {
  auto owned = std::make_unique<std::vector<Value>>(std::move(values));
  const Value* const data = owned->data();
  const py::capsule owner(owned.get(), [](void* vector) { delete static_cast<std::vector<Value>*>(vector); });
  owned.release();
  return py::array_t<Value>(std::move(shape), data, owner);
}
template <class Value>
py::array array_of(std::vector<Value> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

/// The shape of a raster: rows, columns.
inline Shape shape_of(const RasterGrid& grid) {
  return {static_cast<py::ssize_t>(grid.rows()), static_cast<py::ssize_t>(grid.columns())};
}

}  // namespace itin::python
