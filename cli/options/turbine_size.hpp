// The size of a turbine: `--hub-height`, `--rotor-diameter`, `--tip-height`.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/zone_study.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class TurbineSizeOptions {
 public:
  /// `which` says in the help which turbines these sizes are for: "of turbines whose row gives none".
  void declare(CLI::App& app, const std::string& which);
  /// Throws InputError.
  void validate();
  /// The sizes as given, not completed.
  const viewshed::TurbineSize& size() const { return size_; }
  /// The completed sizes. Throws InputError where the options are not enough, or no turbine can have these sizes.
  viewshed::TurbineSize completed() const;
  Document parameters() const;

 private:
  std::string hub_text_, rotor_text_, tip_text_;
  viewshed::TurbineSize size_;
};

}  // namespace itin::cli
