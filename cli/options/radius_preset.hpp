// The distance up to which turbines are looked for, by the height of their tips: `--radius`, `--radius-preset FILE`.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class RadiusOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Reads the preset's file, where one is given. Throws FileError.
  void load();
  /// The radius, in metres, for a height of tips.
  double radius(double tip_height) const;
  /// The rule in force, in the form of a preset's file, so that it can be edited and given again.
  Document document() const;
  /// Describes the rule in one sentence.
  std::string text() const;

 private:
  struct Step {
    double tip_up_to_m = std::numeric_limits<double>::infinity();
    double radius_km = 0;
  };
  std::string radius_text_, preset_path_;
  std::optional<double> fixed_;
  std::string source_;
  std::vector<Step> steps_;  ///< ascending, the last open
};

}  // namespace itin::cli
