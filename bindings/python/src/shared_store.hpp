// A store that several results share, so that each may outlive the object it came from.
#pragma once

#include <memory>
#include <pybind11/pybind11.h>

#include <itin/store.hpp>

namespace itin::python {

using SharedStore = std::shared_ptr<Store>;
using StoreClass = pybind11::class_<Store, SharedStore>;

/// The class Store, once bind_store() has declared it.
inline StoreClass store_class(const pybind11::module_& module) {
  return pybind11::reinterpret_borrow<StoreClass>(module.attr("Store"));
}

}  // namespace itin::python
