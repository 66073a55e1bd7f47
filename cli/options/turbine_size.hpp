// `--hub-height`, `--rotor-diameter`, `--tip-height`: how high a turbine is.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// Metres; two imply the third.
struct TurbineSize {
  std::optional<double> hub, rotor, tip;

  /// Completes what the other two imply. Throws InputError where the tip stays open, or they contradict each other.
  void complete();
};

class TurbineSizeOptions {
 public:
  /// `which` says in the help whose these are: "of turbines whose row gives none".
  void declare(CLI::App& app, const std::string& which);
  /// Throws InputError.
  void validate();
  /// As given: not completed.
  const TurbineSize& size() const { return size_; }
  /// Throws InputError where the options are not enough, or no turbine can have these.
  TurbineSize completed() const;
  Document parameters() const;

 private:
  std::string hub_text_, rotor_text_, tip_text_;
  TurbineSize size_;
};

}  // namespace itin::cli
