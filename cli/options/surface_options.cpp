#include "options/surface_options.hpp"

#include "program/help.hpp"

namespace itin::cli {

void ThemeOptions::declare(CLI::App& app) {
  begin_group(app, kSurface);
  app.add_option(
         "--themes", themes_,
         "Surface features to include: all (the default), none, or their names. Lines of the terrain are always "
         "included; lines that only lie on it, such as roads, change no height and matter to itin tin alone")
      ->type_name("NAME,NAME...");
}

void ThemeOptions::validate() {
  choice_ = ThemeChoice::parse(themes_);
}

}  // namespace itin::cli
