#include "options/radio/wave_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/radio_text.hpp>

#include "program/values.hpp"

namespace itin::cli {

double parse_frequency(const std::string& text) {
  return parsed_by("--frequency", text, profile::parse_frequency_ghz);
}

void declare_fresnel(CLI::App& app, std::string& text) {
  app.add_option("--fresnel", text,
                 "Share of the first Fresnel zone's radius that must be clear, 0 to 1 (default: 0.6)")
      ->type_name("FRACTION");
}

void require_frequency_of_zone(const std::string& fresnel_text, bool has_frequency) {
  if (!fresnel_text.empty() && !has_frequency)
    throw InputError("--fresnel needs a --frequency: the zone's radius depends on it");
}

double parse_fresnel(const std::string& text) {
  const double fraction = parse_number("--fresnel", text, Range::kPositive);
  if (fraction > 1) throw InputError(fmt::format("--fresnel '{}': more than the zone; give 0 to 1", text));
  return fraction;
}

void require_curved(const Earth& earth) {
  if (earth.drop_coefficient() == 0) throw InputError("--frequency needs a curved Earth; leave out --curvature off");
}

void WaveOptions::declare(CLI::App& app, const std::string& frequency_help) {
  app.add_option("--frequency", frequency_text_, frequency_help)->type_name("GHZ");
  app.add_option("--polarisation", polarisation_text_,
                 "Polarisation of the radio wave, horizontal or vertical (default: h)")
      ->type_name("h|v");
  app.add_option("--over-sea", over_sea_text_, "Share of the path that is over sea, 0 to 1 (default: 0)")
      ->type_name("FRACTION");
}

void WaveOptions::validate() {
  if (frequency_text_.empty()) {
    if (is_detailed()) throw InputError("--polarisation and --over-sea work only with --frequency");
    return;
  }
  wave_.emplace();
  wave_->frequency_ghz = parse_frequency(frequency_text_);
  if (!polarisation_text_.empty())
    wave_->polarisation = parsed_by("--polarisation", polarisation_text_, profile::parse_polarisation);
  if (!over_sea_text_.empty()) wave_->over_sea = parse_number("--over-sea", over_sea_text_, Range::kNotNegative);
  if (wave_->over_sea > 1) throw InputError(fmt::format("--over-sea '{}': expected 0 to 1", over_sea_text_));
}

std::optional<RadioPath> WaveOptions::path(const Earth& earth) const {
  if (!wave_) return std::nullopt;
  require_curved(earth);
  RadioPath path = *wave_;
  path.effective_earth_km = effective_earth_km(earth);
  return path;
}

Document WaveOptions::parameters() const {
  if (!wave_) return Document::object();
  return {{"frequency_ghz", wave_->frequency_ghz},
          {"polarisation", wave_->polarisation == Polarisation::kVertical ? "v" : "h"},
          {"over_sea", wave_->over_sea}};
}

}  // namespace itin::cli
