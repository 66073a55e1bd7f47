#include "surface_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::cli {

void ThemeOptions::declare(CLI::App& app) {
  app.add_option("--themes", themes_,
                 "Surface features to include: all, none, or their names (default: none; all with --precise). Lines of the terrain are "
                 "always there")
      ->type_name("NAME,NAME...");
}

void ThemeOptions::validate() {
  if (!themes_.empty()) choice_ = ThemeChoice::parse(themes_);
}

void ThemeOptions::validate_none(const std::string& verb) {
  validate();
  if (!themes_.empty() && themes_ != "none")
    throw InputError(
        fmt::format("--themes {}: itin {} sees the terrain alone so far; leave it out, or say none", themes_, verb));
}

Document ThemeOptions::parameters() const {
  return themes_.empty() ? Document::object() : Document{{"themes", themes_}};
}

}  // namespace itin::cli
