// Radio and clearance: `--frequency`, `--polarisation`, `--over-sea`, `--criterion`, `--visible-height`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <profile/los.hpp>

#include "options/radio/wave_options.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class RadioOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Throws InputError where a criterion requires a frequency and none is given. Links may bring their own.
  void require_frequency() const;
  /// The radio path, with the effective radius of this Earth; nothing without a frequency. Throws InputError for a flat
  /// Earth.
  std::optional<RadioPath> radio(const Earth& earth) const { return wave_.path(earth); }
  const std::vector<profile::Criterion>& criteria() const { return criteria_; }
  const std::optional<profile::TallObject>& object() const { return object_; }
  Document parameters() const;

 private:
  WaveOptions wave_;
  std::string object_text_;
  std::vector<std::string> criteria_text_;
  std::vector<profile::Criterion> criteria_;
  std::optional<profile::TallObject> object_;
};

}  // namespace itin::cli
