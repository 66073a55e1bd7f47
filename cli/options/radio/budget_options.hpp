// Link budgets: `--power-dbm` or `--eirp-dbm`, `--gain-dbi`, `--feeder-loss-db`, `--sensitivity-dbm`,
// `--rain-rate-mm-h`, `--geoclimatic-factor` or `--refractivity-gradient`, `--from-antenna`, `--to-antenna`,
// `--antenna-azimuth`, `--antenna-tilt`.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <profile/diffraction.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class BudgetOptions {
 public:
  /// What a verb calls the two ends of a link.
  struct Ends {
    const char* first = "the first end";
    const char* second = "the second";
    bool single = true;  ///< links are single, which may fade by multipath; else one end is anywhere in an area
  };
  void declare(CLI::App& app, const Ends& ends);
  /// Reads the patterns of antennas. Throws InputError, FileError.
  void validate();
  /// Requires a frequency where a budget is asked for. Throws InputError where there is none, and for a frequency for
  /// which there is no rain or multipath, where these are asked for.
  void require_frequency(const std::optional<profile::RadioPath>& radio) const;
  /// Requires what links can be asked, which may bring the power and everything else themselves. Throws InputError.
  void require_for_links() const;
  bool given() const { return query_.asks(); }
  const profile::BudgetQuery& query() const { return query_; }
  Document parameters() const;

 private:
  void declare_rain(CLI::App& app);
  void declare_multipath(CLI::App& app);

  std::string power_text_, eirp_text_, gain_text_, feeder_text_, sensitivity_text_, rain_text_, factor_text_,
      gradient_text_;
  std::string from_antenna_path_, to_antenna_path_, azimuth_text_, tilt_text_;
  profile::BudgetQuery query_;
};

}  // namespace itin::cli
