#include "options/radio_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/radio_text.hpp>

#include "program/values.hpp"

namespace itin::cli {

namespace {

/// What the library makes of an option's text; its complaint names the option.
template <class Parse>
auto parsed(const char* option, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} '{}': {}", option, text, error.what()));
  }
}

profile::TallObject parse_object(const std::string& text) {
  const std::vector<double> heights = parse_heights("--visible-height", text, Range::kPositive);
  if (heights.size() > 2 || heights.front() > heights.back()) {
    throw InputError(fmt::format("--visible-height '{}': expected TIP, or HUB,TIP with the hub below the tip", text));
  }
  return {heights.front(), heights.back()};
}

}  // namespace

double parse_frequency(const std::string& text) {
  return parsed("--frequency", text, profile::parse_frequency_ghz);
}

void RadioOptions::declare(CLI::App& app) {
  app.add_option("--frequency", frequency_text_,
                 "Work out Fresnel zones and diffraction at this frequency: GHz, or 7500MHz")
      ->type_name("GHZ");
  app.add_option("--polarisation", polarisation_text_, "Of the wave, horizontal or vertical (default: h)")
      ->type_name("h|v");
  app.add_option("--over-sea", over_sea_text_, "Share of the path that is over sea, 0 to 1 (default: 0)")
      ->type_name("FRACTION");
  app.add_option("--criterion", criteria_text_,
                 "Ask for this fraction of the first Fresnel zone on an Earth of this factor; may be given again. ke "
                 "stands for the factor exceeded for 99.9 % of the worst month, 157 / (144 + 2670 / length in km)")
      ->type_name("K:FRACTION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--visible-height", object_text_,
                 "How much of an object this tall at --to is seen: its tip, or a turbine's hub and tip")
      ->type_name("[HUB,]TIP");
}

void RadioOptions::validate() {
  for (const std::string& text : criteria_text_)
    criteria_.push_back(parsed("--criterion", text, profile::parse_criterion));
  if (!object_text_.empty()) object_ = parse_object(object_text_);
  if (frequency_text_.empty()) {
    if (!polarisation_text_.empty() || !over_sea_text_.empty()) {
      throw InputError("--polarisation and --over-sea are of use with --frequency only");
    }
    return;
  }
  radio_.emplace();
  radio_->frequency_ghz = parse_frequency(frequency_text_);
  if (!polarisation_text_.empty())
    radio_->polarisation = parsed("--polarisation", polarisation_text_, profile::parse_polarisation);
  if (!over_sea_text_.empty()) radio_->over_sea = parse_number("--over-sea", over_sea_text_, Range::kNotNegative);
  if (radio_->over_sea > 1) throw InputError(fmt::format("--over-sea '{}': expected 0 to 1", over_sea_text_));
}

void RadioOptions::require_frequency() const {
  for (const profile::Criterion& c : criteria_) {
    if (c.fraction > 0 && !radio_)
      throw InputError("--criterion with a fraction of the Fresnel zone takes a --frequency");
  }
}

std::optional<profile::RadioPath> RadioOptions::radio(const Earth& earth) const {
  if (!radio_) return std::nullopt;
  if (earth.drop_coefficient() == 0) throw InputError("--frequency takes a curved Earth; leave out --curvature off");
  profile::RadioPath path = *radio_;
  path.effective_earth_km = profile::effective_earth_km(earth);
  return path;
}

Document RadioOptions::parameters() const {
  Document parameters = Document::object();
  if (radio_) {
    parameters["frequency_ghz"] = radio_->frequency_ghz;
    parameters["polarisation"] = radio_->polarisation == profile::Polarisation::kVertical ? "v" : "h";
    parameters["over_sea"] = radio_->over_sea;
  }
  if (!criteria_.empty()) {
    parameters["criteria"] = Document::array();
    for (const profile::Criterion& c : criteria_) {
      parameters["criteria"].push_back({{"k", c.fade ? Document("ke") : Document(c.k)}, {"fraction", c.fraction}});
    }
  }
  if (object_) parameters["visible_height_m"] = {{"hub", object_->hub_m}, {"tip", object_->tip_m}};
  return parameters;
}

}  // namespace itin::cli
