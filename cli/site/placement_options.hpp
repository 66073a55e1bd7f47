// `itin site --turbines`: which turbines are placed, how far apart, and what is to be least.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/site_plan.hpp>

#include "options/turbine_size.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class PlacementOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError, also for options of the verb that make no sense for turbines, and for these
  /// options where no turbines are placed.
  void validate();
  Document parameters() const;

  bool given() const { return given_; }
  /// Returns the placement, without the dwellings themselves.
  const viewshed::TurbinePlacement& placement() const { return placement_; }

  std::string dwellings;  ///< a file; empty: none

 private:
  void refuse_others() const;
  void validate_spacing();

  CLI::App* app_ = nullptr;
  bool given_ = false;
  TurbineSizeOptions size_options_;
  std::string minimised_text_ = "tips", spacing_text_, wind_text_, setback_text_;
  viewshed::TurbinePlacement placement_;
};

}  // namespace itin::cli
