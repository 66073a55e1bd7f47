#include "options/radio/earth_options.hpp"

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/error.hpp>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void EarthOptions::declare(CLI::App& app) {
  begin_group(app, kEarth);
  app.add_option("--curvature", curvature_text_, "Whether the earth is curved (default: on)")->type_name("on|off");
  app.add_option(
         "--refraction", refraction_text_,
         "Coefficient k in drop = d^2 (1 - k) / (2 R); 0.075 in the form (1 - 2 k), as in guidance on wind farms, is "
         "0.15 here (default: 0.13)")
      ->type_name("K");
  app.add_option("--earth-radius", radius_text_,
                 "R (default: 6371000, or that of the Moon, Mars, ... where the store's CRS is of these)")
      ->type_name("METRES");
  app.add_option("--effective-earth", effective_text_, "Radio's factor K instead: drop = d^2 / (2 K R)")
      ->type_name("RATIO");
}

void EarthOptions::declare_radius(CLI::App& app) {
  begin_group(app, kEarth);
  app.add_option("--effective-earth-km", effective_km_text_, "The effective Earth's radius instead of its factor K")
      ->type_name("KM");
}

void EarthOptions::require_no_refraction() const {
  const auto refuse = [](const std::string& value, const char* option) {
    if (!value.empty())
      throw InputError(fmt::format(
          "{} and --curvature off exclude each other: a flat Earth has no refraction; leave out one of them", option));
  };
  refuse(refraction_text_, "--refraction");
  refuse(effective_text_, "--effective-earth");
  refuse(effective_km_text_, "--effective-earth-km");
}

void EarthOptions::warn_of_light(std::vector<std::string>& warnings) const {
  if (is_default())
    warnings.emplace_back(
        "the refraction is that of light; radio links are usually planned with --effective-earth 4/3");
}

void EarthOptions::validate() {
  if (!effective_km_text_.empty() && !(refraction_text_.empty() && effective_text_.empty())) {
    throw InputError("--effective-earth-km excludes --effective-earth and --refraction: they state the same");
  }
  if (!refraction_text_.empty() && !effective_text_.empty()) {
    throw InputError("--refraction and --effective-earth exclude each other: they state the same in two conventions");
  }
  if (!curvature_text_.empty()) earth_.curvature = parse_switch("--curvature", curvature_text_);
  if (!earth_.curvature) require_no_refraction();
  if (!refraction_text_.empty()) earth_.refraction = parse_number("--refraction", refraction_text_);
  if (!radius_text_.empty()) earth_.radius = parse_number("--earth-radius", radius_text_, Range::kPositive);
  if (!effective_text_.empty()) earth_.effective_factor = parse_ratio("--effective-earth", effective_text_);
  set_effective_km();
  earth_.validate();
}

void EarthOptions::set_effective_km() {
  if (effective_km_text_.empty()) return;
  earth_.effective_factor =
      parse_number("--effective-earth-km", effective_km_text_, Range::kPositive) * 1000 / earth_.radius;
}

void EarthOptions::take_body_of(const StoreMetadata& metadata) {
  const CelestialBody body = body_of(metadata.crs_wkt);
  if (body.is_earth || !radius_text_.empty()) return;
  earth_.radius = body.mean_radius_m();
  set_effective_km();
}

}  // namespace itin::cli
