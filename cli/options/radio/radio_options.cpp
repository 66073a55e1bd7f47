#include "options/radio/radio_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/radio_text.hpp>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

profile::TallObject parse_object(const std::string& text) {
  const std::vector<double> heights = parse_heights("--visible-height", text, Range::kPositive);
  if (heights.size() > 2 || heights.front() > heights.back()) {
    throw InputError(fmt::format("--visible-height '{}': expected TIP, or HUB,TIP with the hub below the tip", text));
  }
  return {heights.size() > 1 ? std::optional(heights.front()) : std::nullopt, heights.back()};
}

}  // namespace

void RadioOptions::declare(CLI::App& app) {
  begin_group(app, kRadio);
  wave_.declare(app, "Work out Fresnel zones and diffraction at this frequency: GHz, or 7500MHz");
  app.add_option(
         "--criterion", criteria_text_,
         "Ask for this fraction of the first Fresnel zone on an Earth of this factor; may be given again. ke "
         "stands for the factor exceeded for 99.9 % of the worst month, 157 / (144 + 2670 / length in km), below 10 "
         "km that of 10 km")
      ->type_name("K:FRACTION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--visible-height", object_text_,
                 "How much of an object this tall at --to is seen: its tip, or a turbine's hub and tip")
      ->type_name("[HUB,]TIP");
}

void RadioOptions::validate() {
  for (const std::string& text : criteria_text_)
    criteria_.push_back(parsed_by("--criterion", text, profile::parse_criterion));
  if (!object_text_.empty()) object_ = parse_object(object_text_);
  wave_.validate();
}

void RadioOptions::require_frequency() const {
  for (const profile::Criterion& c : criteria_) {
    if (c.fraction > 0 && !wave_.has_frequency())
      throw InputError("--criterion with a fraction of the Fresnel zone needs a --frequency");
  }
}

Document RadioOptions::parameters() const {
  Document parameters = wave_.parameters();
  if (!criteria_.empty()) {
    parameters["criteria"] = Document::array();
    for (const profile::Criterion& c : criteria_) {
      parameters["criteria"].push_back({{"k", c.fade ? Document("ke") : Document(c.k)}, {"fraction", c.fraction}});
    }
  }
  if (object_) {
    parameters["visible_height_m"] = {{"tip", object_->tip_m}};
    if (object_->hub_m) parameters["visible_height_m"]["hub"] = *object_->hub_m;
  }
  return parameters;
}

}  // namespace itin::cli
