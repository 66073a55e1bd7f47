#include "options/radius_preset.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

// These facts were collected from guidance, and not confirmed from the primary text: an assumption, then.
constexpr const char* kBuiltinSource = "radii by tip height assumed after UK practice";

}  // namespace

void RadiusOptions::declare(CLI::App& app) {
  app.add_option("--radius", radius_text_,
                 "How far from each turbine its visibility is assessed (default: by its tip height)")
      ->type_name("METRES");
  reads(app.add_option(
               "--radius-preset", preset_path_,
               "Radius by tip height from this file: {\"source\": ..., \"radii\": [{\"tip_up_to_m\": 50, "
               "\"radius_km\": 15}, ..., {\"radius_km\": 45}]}; a run writes the one it used (default: built in, 15 "
               "to 45 km)")
            ->type_name("FILE"));
}

void RadiusOptions::validate() {
  if (!radius_text_.empty() && !preset_path_.empty())
    throw InputError("--radius and --radius-preset exclude each other");
  if (!radius_text_.empty()) fixed_ = parse_radius("--radius", radius_text_);
  source_ = kBuiltinSource;
  steps_ = {
      {50, 15}, {70, 20}, {85, 25}, {100, 30}, {130, 35}, {150, 40}, {std::numeric_limits<double>::infinity(), 45}};
}

void RadiusOptions::load() {
  if (preset_path_.empty()) return;
  std::ifstream in(preset_path_);
  if (!in) throw FileError(preset_path_, "cannot be read; name a preset's file");
  const Document preset = Document::parse(in, nullptr, false);
  const auto refuse = [&](const std::string& what) { throw FileError(preset_path_, what + "; see --radius-preset"); };
  if (!preset.is_object() || !preset.contains("radii") || !preset["radii"].is_array() || preset["radii"].empty())
    refuse("is not a preset of radii");
  if (!preset.contains("source") || !preset["source"].is_string()) refuse("does not say its source");
  source_ = preset["source"];
  steps_.clear();
  double last = 0;
  for (const Document& entry : preset["radii"]) {
    Step step;
    const auto number = [&](const char* name) {
      const bool usable = entry.is_object() && entry.contains(name) && entry[name].is_number() && entry[name] > 0;
      if (!usable) refuse(fmt::format("entry {}: {} is not a positive number", steps_.size() + 1, name));
      return entry[name].get<double>();
    };
    step.radius_km = number("radius_km");
    const bool open = &entry == &preset["radii"].back() && !entry.contains("tip_up_to_m");
    if (!open) step.tip_up_to_m = number("tip_up_to_m");
    if (step.tip_up_to_m <= last) refuse("its tip heights do not ascend");
    last = step.tip_up_to_m;
    steps_.push_back(step);
  }
  if (std::isfinite(last)) refuse("its last entry must have no tip_up_to_m: the radius of all higher turbines");
}

double RadiusOptions::radius(double tip_height) const {
  if (fixed_) return *fixed_;
  for (const Step& step : steps_)
    if (tip_height <= step.tip_up_to_m) return step.radius_km * 1000;
  return steps_.back().radius_km * 1000;
}

Document RadiusOptions::document() const {
  if (fixed_) return {{"source", "--radius"}, {"radii", {{{"radius_km", *fixed_ / 1000}}}}};
  Document radii = Document::array();
  for (const Step& step : steps_) {
    Document entry = Document::object();
    if (std::isfinite(step.tip_up_to_m)) entry["tip_up_to_m"] = step.tip_up_to_m;
    entry["radius_km"] = step.radius_km;
    radii.push_back(entry);
  }
  return {{"source", source_}, {"radii", radii}};
}

std::string RadiusOptions::text() const {
  if (fixed_) return fmt::format("The study area extends to {:g} km from every turbine.", *fixed_ / 1000);
  std::string text = "The study area extends to a distance from each turbine that depends on its tip height: ";
  for (const Step& step : steps_) {
    text += std::isfinite(step.tip_up_to_m)
                ? fmt::format("{:g} km for tips up to {:g} m, ", step.radius_km, step.tip_up_to_m)
                : fmt::format("{:g} km above that", step.radius_km);
  }
  return text + " (" + source_ + ").";
}

}  // namespace itin::cli
