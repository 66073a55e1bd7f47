// Long calls from Python: on a thread of their own, without the interpreter's lock, with progress and signals heard.
#pragma once

#include <functional>
#include <optional>
#include <pybind11/pybind11.h>

#include <itin/progress.hpp>

namespace itin::python {

namespace py = pybind11;

/// Notes the process that the module is used in.
void note_process();

/// Runs `work` on a thread of its own and returns when it ends. Every 50 milliseconds the calling thread hears signals,
/// and calls `show(stage, fraction)` unless that is None. What either raises stops the work, and is raised when the
/// work has ended. Throws what the work throws; Error in a process that was forked since note_process(), which has none
/// of the threads that the libraries work with. The caller holds the interpreter's lock, the work does not.
void run(const py::object& show, const std::function<void(Progress&)>& work);

/// Returns the result of `work`, which is run by run().
template <class Work>
auto result_of(const py::object& show, const Work& work) {
  std::optional<decltype(work(std::declval<Progress&>()))> result;
  run(show, [&](Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

}  // namespace itin::python
