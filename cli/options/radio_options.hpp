// Radio and clearance: `--frequency`, `--polarisation`, `--over-sea`, `--criterion`, `--visible-height`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <profile/los.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class RadioOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// With the effective radius of this Earth; nothing without a frequency. Throws InputError for a flat Earth.
  std::optional<profile::RadioPath> radio(const Earth& earth) const;
  const std::vector<profile::Criterion>& criteria() const { return criteria_; }
  const std::optional<profile::TallObject>& object() const { return object_; }
  Document parameters() const;

 private:
  std::string frequency_text_, polarisation_text_, over_sea_text_, object_text_;
  std::vector<std::string> criteria_text_;
  std::optional<profile::RadioPath> radio_;
  std::vector<profile::Criterion> criteria_;
  std::optional<profile::TallObject> object_;
};

}  // namespace itin::cli
