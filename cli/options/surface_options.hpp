// Options about features on the surface.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/theme.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// `--themes all|none|name,name`: everything that was imported counts, unless a call leaves it out.
class ThemeOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  const ThemeChoice& choice() const { return choice_; }
  Document parameters() const { return {{"themes", themes_}}; }

 private:
  std::string themes_ = "all";
  ThemeChoice choice_ = ThemeChoice::all();
};

}  // namespace itin::cli
