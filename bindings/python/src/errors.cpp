#include "errors.hpp"

#include <array>
#include <exception>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

#include <itin/error.hpp>

namespace itin::python {

namespace {

namespace py = pybind11;

/// Fields of requests that arguments of other names stand for.
constexpr std::array kArguments{std::pair{"extinction", "foliage"}, std::pair{"least_transmittance", "transmittance"}};

/// Makes an error of this class, and raises it.
template <class... Data>
void raise(const char* name, const Data&... data) {
  const py::object type = py::module_::import("itin._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(data...).ptr());
}

/// Raises an error about a field as one about the argument that stands for it.
void raise_input_error(const InputError& error) {
  std::string message = error.what(), field = error.field();
  for (const auto& [of_request, argument] : kArguments) {
    if (field != of_request) continue;
    const std::string quoted = "`" + field + "`";
    if (const std::size_t at = message.find(quoted); at != std::string::npos)
      message.replace(at + 1, field.size(), argument);
    field = argument;
  }
  raise("InputError", message, field);
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
      raise_input_error(error);
    } catch (const Error& error) {
      raise("Error", error.what());
    }
  });
}

}  // namespace itin::python
