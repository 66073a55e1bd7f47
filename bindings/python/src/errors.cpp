#include "errors.hpp"

#include <exception>
#include <pybind11/pybind11.h>

#include <itin/error.hpp>

namespace itin::python {

namespace {

namespace py = pybind11;

/// Makes an error of this class, and raises it.
template <class... Data>
void raise(const char* name, const Data&... data) {
  const py::object type = py::module_::import("itin._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(data...).ptr());
}

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const CorruptStore& error) {
      raise("CorruptStore", error.what(), error.path(), error.place());
    } catch (const FileError& error) {
      raise("FileError", error.what(), error.path());
    } catch (const InputError& error) {
      raise("InputError", error.what(), error.field());
    } catch (const Error& error) {
      raise("Error", error.what());
    }
  });
}

}  // namespace itin::python
