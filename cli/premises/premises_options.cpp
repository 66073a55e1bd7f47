#include "premises/premises_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/site_list.hpp>

#include "options/places/mast_file.hpp"
#include "options/places/off_the_data.hpp"
#include "options/places/taken_heights.hpp"
#include "options/radio/wave_options.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void PremisesOptions::declare(CLI::App& app) {
  reads(app.add_option("STORE", store, "The store")->required());
  declare_masts(app);
  declare_antennas(app);
  begin_group(app, kOutputs);
  replaces(app.add_option("-o,--output", directory, "The folder to write")->type_name("DIR")->required());
  policy.declare(app);
  sheets_.declare_names(app);
  declare_work(app);
}

void PremisesOptions::declare_masts(CLI::App& app) {
  begin_group(app, "Masts");
  declare_mast_file(app, {"--masts", "Masts", "name, or one like it"}, masts_)->required();
  app.add_option("--mast-height", mast_height_text_, "Height of masts without one of their own (default: 20)")
      ->type_name("METRES");
  app.add_option("--observer-on", observer_on_,
                 "Masts stand on the ground (default), or on the surface with the roofs of --themes")
      ->type_name("ground|surface");
  in_crs_.declare(app);
  app.add_option("--radius", radius_text_, "How far a mast serves (default: 1000)")->type_name("METRES");
}

void PremisesOptions::declare_antennas(CLI::App& app) {
  begin_group(app, "Antennas on buildings");
  antennas_.declare(app, "--spacing");
  app.add_option("--setback", setback_text_,
                 "Tell of each place on the roofs the least pole that is served, and the least that sees the street, "
                 "which lies this far before the walls (roofs.csv)")
      ->type_name("METRES");
  app.add_option("--frequency", frequency_text_,
                 "Serve only what is in sight with its first Fresnel zone clear at this frequency: GHz, or 7500MHz")
      ->type_name("GHZ");
  declare_fresnel(app, fresnel_text_);
}

void PremisesOptions::declare_work(CLI::App& app) {
  themes_.declare(app);
  earth_.declare(app);
  nodata_.declare(app);
  memory_.declare(app,
                  "Memory to work in, for example 2G. Surfaces that exceed it are read in parts; the result does not "
                  "depend on it (default: 1G)");
}

void PremisesOptions::validate() {
  themes_.validate();
  earth_.validate();
  sheets_.validate(true);
  request_.nodata = nodata_.rule();
  request_.memory_bytes = memory_.bytes().value_or(request_.memory_bytes);
  request_.masts_on_surface = parse_choice("--observer-on", observer_on_, {"ground", "surface"}) == 1;
  if (!masts_.height_field.empty() && !mast_height_text_.empty())
    throw InputError("--height-field and --mast-height exclude each other");
  if (!mast_height_text_.empty())
    request_.mast_height = parse_height("--mast-height", mast_height_text_, Range::kNotNegative);
  if (!radius_text_.empty()) request_.radius = parse_radius("--radius", radius_text_);
  validate_antennas();
}

void PremisesOptions::validate_antennas() {
  antennas_.validate();
  static_cast<viewshed::AntennaPlaces&>(request_) = antennas_.places();
  if (!setback_text_.empty()) request_.setback = parse_number("--setback", setback_text_, Range::kPositive);
  require_frequency_of_zone(fresnel_text_, !frequency_text_.empty());
  if (frequency_text_.empty()) return;
  request_.frequency_ghz = parse_frequency(frequency_text_);
  if (!fresnel_text_.empty()) request_.fresnel = parse_fresnel(fresnel_text_);
  require_curved(earth_.earth());
}

viewshed::PremisesRequest PremisesOptions::complete_request(const Store& read, Progress& progress) {
  const StoreMetadata& metadata = read.metadata();
  earth_.take_body_of(metadata);
  request_.earth = earth_.earth();
  themes_.choice().check(metadata.themes);
  themes_.complete(read, progress);
  request_.themes = themes_.choice();
  viewshed::SitePlaces& masts = request_.masts;
  take_fields(masts.warnings);
  masts.source = masts_.path;
  masts_.crs = in_crs_.crs;
  for (const Site& site : read_sites(masts_, metadata.crs_wkt, masts.warnings)) {
    const std::string name = site.name.empty() ? std::to_string(site.row) : site.name;
    require_on_the_data(fmt::format("{}: mast {}", masts_.path, name), site.position, in_crs_, metadata);
    masts.places.push_back({.name = name, .position = site.position, .height = site.height, .origin = site.place});
  }
  if (masts.places.empty()) throw InputError(none_in(masts_, "mast"));
  return request_;
}

void PremisesOptions::take_fields(std::vector<std::string>& warnings) {
  const LayerFields fields(masts_);
  take_names(masts_, fields);
  if (!masts_.height_field.empty()) return;
  take_heights(masts_, fields, {mast_height_text_.empty() ? "" : "--mast-height", "--height-field"}, warnings);
  took_heights_ = !masts_.height_field.empty();
}

std::string PremisesOptions::heights_text() const {
  return taken_heights_text("masts", took_heights_ ? masts_.height_field : "", masts_.path);
}

void PremisesOptions::warn_of_light(std::vector<std::string>& warnings) const {
  if (request_.frequency_ghz) earth_.warn_of_light(warnings);
}

Document PremisesOptions::parameters() const {
  Document p{{"store", store}, {"masts", masts_.path}};
  if (!masts_.height_field.empty()) p["height_field"] = masts_.height_field;
  p["mast_height_m"] = request_.mast_height;
  p["observer_on"] = observer_on_;
  p["radius_m"] = request_.radius;
  p.update(antennas_.parameters());
  if (request_.setback) p["setback_m"] = *request_.setback;
  if (request_.frequency_ghz) p["frequency_ghz"] = *request_.frequency_ghz, p["fresnel"] = request_.fresnel;
  p.update(themes_.parameters());
  p["nodata"] = nodata_.text();
  p.update(sheets_.parameters());
  return p;
}

}  // namespace itin::cli
