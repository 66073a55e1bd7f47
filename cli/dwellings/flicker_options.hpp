// Options about shadow flicker.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/dwellings.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class FlickerOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options, and reads the file of months. Throws InputError, FileError.
  void validate();
  const viewshed::FlickerRules& rules() const { return rules_; }
  Document parameters() const;

 private:
  viewshed::FlickerRules rules_;
  std::string year_text_, zone_text_, limits_text_, elevation_text_, reach_text_, blade_text_, months_;
};

}  // namespace itin::cli
