#include "options/engine_option.hpp"

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void EngineOption::declare(CLI::App& app) {
  begin_group(app, kRunning);
  app.add_option(
         "--engine", text_,
         "What decides sight lines to cells: a sweep about each observer, rays, or auto (the default), which takes "
         "the faster of the two. The result does not depend on it")
      ->type_name("auto|sweep|rays");
}

viewshed::Engine EngineOption::engine() const {
  using enum viewshed::Engine;
  constexpr viewshed::Engine kChoices[] = {kAuto, kSweep, kRays};
  return kChoices[parse_choice("--engine", text_, {"auto", "sweep", "rays"})];
}

}  // namespace itin::cli
