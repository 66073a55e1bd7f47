// The distance up to which turbines are looked for, by the height of their tips: `--radius`, `--radius-preset FILE`.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/zone_study.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class RadiusOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Reads the preset's file, where one is given. Throws FileError.
  void load();
  const viewshed::RadiusRule& rule() const { return rule_; }
  /// The rule in force, in the form of a preset's file, so that it can be edited and given again.
  Document document() const;

 private:
  std::string radius_text_, preset_path_;
  viewshed::RadiusRule rule_;
};

}  // namespace itin::cli
