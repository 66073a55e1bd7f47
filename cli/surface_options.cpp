#include "surface_options.hpp"

namespace itin::cli {

void ThemeOptions::declare(CLI::App& app, const std::string& otherwise) {
  app.add_option("--themes", themes_,
                 "Surface features to include: all, none, or their names (" + otherwise +
                     "). Lines of the terrain are always there; lines that only lie on it, as roads do, change no "
                     "height and come with itin tin alone")
      ->type_name("NAME,NAME...");
}

void ThemeOptions::validate() {
  if (!themes_.empty()) choice_ = ThemeChoice::parse(themes_);
}

Document ThemeOptions::parameters() const {
  return themes_.empty() ? Document::object() : Document{{"themes", themes_}};
}

}  // namespace itin::cli
