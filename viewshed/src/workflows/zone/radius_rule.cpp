#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/radius_document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

double RadiusRule::radius(double tip_height) const {
  if (fixed) return *fixed;
  for (const Step& step : steps)
    if (tip_height <= step.tip_up_to_m) return step.radius_km * 1000;
  return steps.back().radius_km * 1000;
}

RadiusRule read_radius_rule(const std::string& path) {
  RadiusRule rule;
  std::ifstream in(path);
  if (!in) throw FileError(path, "cannot be read; name a preset's file");
  const Document preset = Document::parse(in, nullptr, false);
  const auto refuse = [&](const std::string& what) { throw FileError(path, what + "; see `radius_rule`"); };
  if (!preset.is_object() || !preset.contains("radii") || !preset["radii"].is_array() || preset["radii"].empty())
    refuse("is not a preset of radii");
  if (!preset.contains("source") || !preset["source"].is_string()) refuse("does not say its source");
  rule.source = preset["source"];
  rule.steps.clear();
  double last = 0;
  for (const Document& entry : preset["radii"]) {
    RadiusRule::Step step;
    const auto number = [&](const char* name) {
      const bool usable = entry.is_object() && entry.contains(name) && entry[name].is_number() && entry[name] > 0;
      if (!usable) refuse(fmt::format("entry {}: {} is not a positive number", rule.steps.size() + 1, name));
      return entry[name].get<double>();
    };
    step.radius_km = number("radius_km");
    const bool open = &entry == &preset["radii"].back() && !entry.contains("tip_up_to_m");
    if (!open) step.tip_up_to_m = number("tip_up_to_m");
    if (step.tip_up_to_m <= last) refuse("its tip heights do not ascend");
    last = step.tip_up_to_m;
    rule.steps.push_back(step);
  }
  if (std::isfinite(last)) refuse("its last entry must have no tip_up_to_m: the radius of all higher turbines");
  return rule;
}

Document radius_document(const RadiusRule& rule) {
  if (rule.fixed) return {{"source", rule.source}, {"radii", {{{"radius_km", *rule.fixed / 1000}}}}};
  Document radii = Document::array();
  for (const RadiusRule::Step& step : rule.steps) {
    Document entry = Document::object();
    if (std::isfinite(step.tip_up_to_m)) entry["tip_up_to_m"] = step.tip_up_to_m;
    entry["radius_km"] = step.radius_km;
    radii.push_back(entry);
  }
  return {{"source", rule.source}, {"radii", radii}};
}

std::string radius_text(const RadiusRule& rule, bool of_proposal) {
  const char* const turbine = of_proposal ? "proposed turbine" : "turbine";
  if (rule.fixed) return fmt::format("The study area extends to {:g} km from every {}.", *rule.fixed / 1000, turbine);
  std::string text =
      fmt::format("The study area extends to a distance from each {} that depends on its tip height: ", turbine);
  for (const RadiusRule::Step& step : rule.steps) {
    text += std::isfinite(step.tip_up_to_m)
                ? fmt::format("{:g} km for tips up to {:g} m, ", step.radius_km, step.tip_up_to_m)
                : fmt::format("{:g} km above that", step.radius_km);
  }
  return text + " (" + rule.source + ").";
}

}  // namespace itin::viewshed
