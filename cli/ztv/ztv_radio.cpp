#include "ztv/ztv_radio.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/links.hpp>

#include "options/places/off_the_data.hpp"
#include "options/radio/wave_options.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

void ZtvRadioOptions::declare(CLI::App& app) {
  begin_group(app, "Radio links and radar");
  reads(app.add_option(
               "--links", links_path_,
               "Radio links that rotors must stay clear of: a table id,x1,y1,h1,x2,y2,h2 (.csv), or a file of lines")
            ->type_name("FILE"));
  app.add_option("--frequency", frequency_text_, "Frequency of the radio links, GHz, or 7500MHz")->type_name("GHZ");
  app.add_option("--radar", radar_text_, "A radar, h metres above the bare ground, whose radar horizon is computed")
      ->type_name("x,y,h");
}

void ZtvRadioOptions::validate() {
  if (links_path_.empty() != frequency_text_.empty()) throw InputError("--links and --frequency go together");
  if (!frequency_text_.empty()) frequency_ghz_ = parse_frequency(frequency_text_);
  if (radar_text_.empty()) return;
  radar_place_ = parse_place("--radar", radar_text_);
  if (!radar_place_->height) throw InputError(fmt::format("--radar '{}': expected x,y,h", radar_text_));
  if (*radar_place_->height < 0) throw InputError("--radar: a height must not be negative; 0 is the ground itself");
}

Document ZtvRadioOptions::parameters() const {
  Document parameters = Document::object();
  if (!links_path_.empty()) parameters["links"] = links_path_, parameters["frequency_ghz"] = frequency_ghz_;
  if (radar_)
    parameters["radar"] = {{"x", radar_->position.x}, {"y", radar_->position.y}, {"height_m", radar_->height}};
  return parameters;
}

void ZtvRadioOptions::complete(viewshed::ZoneStudyRequest& request, const InCrs& in_crs,
                               const StoreMetadata& metadata) {
  if (radar_place_) {
    const std::string what = fmt::format("--radar '{}'", radar_text_);
    const Point2 position = on_the_data(what, *radar_place_, in_crs, metadata);
    request.zone.radar = radar_ = viewshed::Observer{"radar", position, *radar_place_->height};
  }
  if (links_path_.empty()) return;
  request.links = profile::read_link_table(links_path_, metadata.crs_wkt, {}, in_crs.crs);
  request.frequency_ghz = frequency_ghz_;
}

}  // namespace itin::cli
