#include "surface_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::cli {

void ThemeOptions::declare(CLI::App& app) {
  app.add_option("--themes", themes_, "Surface features to include (this version: none)")->type_name("none");
}

void ThemeOptions::validate() const {
  // `all` of no themes is none.
  if (themes_ == "none" || themes_ == "all") return;
  throw InputError(
      fmt::format("--themes '{}': this version's stores hold no themes; leave it out or give none", themes_));
}

}  // namespace itin::cli
