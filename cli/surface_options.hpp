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
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  const ThemeChoice& choice() const { return choice_; }
  bool given() const { return !themes_.empty(); }
  /// Whether any features were asked for.
  bool any() const { return given() && themes_ != "none"; }
  /// For verbs that see the terrain alone, so far. Throws InputError where features are asked for.
  void validate_none(const std::string& verb);
  /// What was asked for, where it was.
  Document parameters() const;

 private:
  std::string themes_;
  ThemeChoice choice_ = ThemeChoice::none();
};

}  // namespace itin::cli
