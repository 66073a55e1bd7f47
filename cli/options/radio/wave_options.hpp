// A radio wave: `--frequency`, `--polarisation`, `--over-sea`.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// Reads the value of --frequency, in GHz. Throws InputError.
double parse_frequency(const std::string& text);

/// Declares --fresnel, the part of the first Fresnel zone's radius that must be clear.
void declare_fresnel(CLI::App& app, std::string& text);
/// Throws InputError where --fresnel is given without a frequency.
void require_frequency_of_zone(const std::string& fresnel_text, bool has_frequency);
/// Reads the value of --fresnel: above 0, at most 1. Throws InputError.
double parse_fresnel(const std::string& text);

/// Throws InputError where rays at a frequency would run over a flat Earth.
void require_curved(const Earth& earth);

class WaveOptions {
 public:
  /// `frequency_help` says what the verb does at that frequency.
  void declare(CLI::App& app, const std::string& frequency_help);
  /// Throws InputError.
  void validate();
  bool has_frequency() const { return wave_.has_value(); }
  /// The wave without the Earth that it runs over; nothing without a frequency.
  const std::optional<RadioPath>& wave() const { return wave_; }
  /// Whether more than a frequency was given.
  bool is_detailed() const { return !polarisation_text_.empty() || !over_sea_text_.empty(); }
  /// The radio path, with the effective radius of this Earth; nothing without a frequency. Throws what require_curved()
  /// throws.
  std::optional<RadioPath> path(const Earth& earth) const;
  Document parameters() const;

 private:
  std::string frequency_text_, polarisation_text_, over_sea_text_;
  std::optional<RadioPath> wave_;
};

}  // namespace itin::cli
