// A viewshed of radio: `--frequency`, `--fresnel`, `--loss`, `--polarisation`, `--over-sea`, link budgets,
// `--margin-db`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <viewshed/result.hpp>

#include "options/radio/budget_options.hpp"
#include "options/radio/wave_options.hpp"

namespace itin::cli {

class ViewshedRadio {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Whether radio is asked for, which has modes of its own.
  bool is_given() const { return wave_.has_frequency(); }
  /// Completes the request. Precondition: is_given(). Throws InputError for a flat Earth.
  void complete(viewshed::Request& request) const;
  Document parameters() const;

 private:
  void validate_losses() const;
  void take_margins();

  WaveOptions wave_;
  BudgetOptions budget_;
  std::string fresnel_text_, margins_text_;
  std::vector<double> margins_db_;
  bool loss_ = false;
  double fraction_ = 0.6;
};

/// The criterion by which the cells of a map of radio are judged; nothing in other modes.
std::optional<std::string> radio_criterion(const viewshed::Request& request);

/// The line of a call's text that gives the number of cells in each class.
std::string radio_text(const viewshed::Result& result);

}  // namespace itin::cli
