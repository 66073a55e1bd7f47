// `itin site --turbines`: which turbines are placed, how far apart, and what is to be least.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/turbine_layout.hpp>

#include "options/turbine_size.hpp"
#include "program/verb.hpp"

namespace itin::cli {

/// The quantity that is to be least: the demand that sees a tip, or a hub; or the visible height of all turbines,
/// summed over the demand.
enum class Minimised { kTips, kHubs, kHeight };

class PlacementOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError, also for options of the verb that make no sense for turbines, and for these
  /// options where no turbines are placed.
  void validate();
  Document parameters() const;

  bool given() const { return given_; }
  double hub_height() const { return *size_.hub; }
  double rotor_diameter() const { return *size_.rotor; }
  double tip_height() const { return *size_.tip; }
  Minimised minimised() const { return minimised_; }
  bool sums_heights() const { return given_ && minimised_ == Minimised::kHeight; }
  /// Returns the height above the ground of the part that is looked for: the tip or the hub.
  double minimised_height() const { return minimised_ == Minimised::kHubs ? hub_height() : tip_height(); }
  /// Returns "the tip" or "the hub".
  const char* minimised_part() const { return minimised_ == Minimised::kHubs ? "the hub" : "the tip"; }
  const std::optional<viewshed::TurbineSpacing>& spacing() const { return spacing_; }
  double setback() const { return setback_; }

  std::string dwellings;  ///< a file; empty: none
  std::string farm = "proposed";

 private:
  void refuse_others() const;
  void validate_spacing();

  CLI::App* app_ = nullptr;
  bool given_ = false;
  TurbineSizeOptions size_options_;
  TurbineSize size_;
  std::string minimised_text_ = "tips", spacing_text_, wind_text_, setback_text_;
  Minimised minimised_ = Minimised::kTips;
  std::optional<viewshed::TurbineSpacing> spacing_;
  double setback_ = 0;
};

}  // namespace itin::cli
