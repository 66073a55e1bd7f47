#include "module.hpp"

#include <itin/network.hpp>
#include <itin/progress.hpp>

#include "call.hpp"
#include "errors.hpp"

PYBIND11_MODULE(_itin, module) {
  using namespace itin::python;
  note_process();
  translate_errors();
  module.attr("version") = ITIN_VERSION;
  module.def("set_thread_count", &itin::set_thread_count);
  module.def("thread_count", &itin::thread_count);
  module.def("allow_network", &itin::allow_network);
  bind_store(module);
  bind_import(module);
  bind_lines(module);
  bind_viewsheds(module);
  bind_site_plans(module);
  bind_zone_studies(module);
  bind_dwellings(module);
}
