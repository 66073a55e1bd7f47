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
  void declare(CLI::App& app);
  /// Reads the patterns of antennas. Throws InputError, FileError.
  void validate();
  /// Requires a frequency where a budget is asked for. Throws InputError where there is none, and for a frequency for
  /// which there is no rain or multipath, where these are asked for.
  void require_frequency(const std::optional<profile::RadioPath>& radio) const;
  /// Requires what links can be asked, which may bring the power and everything else themselves. Throws InputError.
  void require_for_links() const;
  const profile::BudgetQuery& query() const { return query_; }
  Document parameters() const;

 private:
  std::string power_text_, eirp_text_, gain_text_, feeder_text_, sensitivity_text_, rain_text_, factor_text_,
      gradient_text_;
  std::string from_antenna_path_, to_antenna_path_, azimuth_text_, tilt_text_;
  profile::BudgetQuery query_;
};

}  // namespace itin::cli
