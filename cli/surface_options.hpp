// Options about features on the surface.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/theme.hpp>

#include "verb.hpp"

namespace itin::cli {

/// `--themes all|none|name,name`.
class ThemeOptions {
 public:
  /// `otherwise`: what the help says of the default.
  void declare(CLI::App& app, const std::string& otherwise = "default: none");
  /// Throws InputError.
  void validate();
  const ThemeChoice& choice() const { return choice_; }
  bool given() const { return !themes_.empty(); }
  /// What was asked for, where it was.
  Document parameters() const;

 private:
  std::string themes_;
  ThemeChoice choice_ = ThemeChoice::none();
};

}  // namespace itin::cli
