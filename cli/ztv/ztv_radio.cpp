#include "ztv/ztv_radio.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <itin/error.hpp>
#include <profile/links.hpp>
#include <viewshed/link_exclusion.hpp>

#include "options/nodata_option.hpp"
#include "options/off_the_data.hpp"
#include "options/wave_options.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

using viewshed::Turbine;
using viewshed::Zone;

namespace {

/// Returns how many turbines a radar sees at least in part.
std::size_t seen_in(const std::vector<double>& turbine_m) {
  return static_cast<std::size_t>(std::count_if(turbine_m.begin(), turbine_m.end(), [](double m) { return m > 0; }));
}

/// Tells whether ground without data alone leaves it open that turbine k of the request is seen.
bool radar_leaves_open(const viewshed::RadarView& radar, std::size_t k) {
  return !radar.undecided_turbine_m.empty() && radar.undecided_turbine_m[k] > 0;
}

}  // namespace

void ZtvRadioOptions::declare(CLI::App& app) {
  begin_group(app, "Radio links and radar");
  reads(app.add_option(
               "--links", links_path_,
               "Radio links that rotors must stay clear of: a table id,x1,y1,h1,x2,y2,h2 (.csv), or a file of lines")
            ->type_name("FILE"));
  app.add_option("--frequency", frequency_text_, "Frequency of the radio links, GHz, or 7500MHz")->type_name("GHz");
  app.add_option("--radar", radar_text_, "A radar, h metres above the bare ground, whose radar horizon is computed")
      ->type_name("x,y,h");
}

void ZtvRadioOptions::validate() {
  if (links_path_.empty() != frequency_text_.empty()) throw InputError("--links and --frequency go together");
  if (!frequency_text_.empty()) frequency_ghz_ = parse_frequency(frequency_text_);
  if (radar_text_.empty()) return;
  radar_place_ = parse_place("--radar", radar_text_);
  if (!radar_place_->height) throw InputError(fmt::format("--radar '{}': expected x,y,h", radar_text_));
  if (*radar_place_->height < 0) throw InputError("--radar: its height must not be negative");
}

Document ZtvRadioOptions::parameters() const {
  Document parameters = Document::object();
  if (!links_path_.empty()) parameters["links"] = links_path_, parameters["frequency_ghz"] = frequency_ghz_;
  if (radar_)
    parameters["radar"] = {{"x", radar_->position.x}, {"y", radar_->position.y}, {"height_m", radar_->height}};
  return parameters;
}

void ZtvRadioOptions::load(const InCrs& in_crs, const StoreMetadata& metadata) {
  if (radar_place_) {
    const std::string what = fmt::format("--radar '{}'", radar_text_);
    const Point2 position = on_the_data(what, *radar_place_, in_crs, metadata);
    radar_ = viewshed::Observer{"radar", position, *radar_place_->height};
  }
  if (links_path_.empty()) return;
  const profile::LinkTable table = profile::read_link_table(links_path_, metadata.crs_wkt, {}, in_crs.crs);
  for (const profile::Link& link : table.links) links_.push_back({link.id, link.from, link.to});
  for (const profile::BadLink& link : table.bad)
    bad_links_.push_back(
        {link.row, static_cast<std::int64_t>(link.row), fmt::format("feature {}", link.row), link.message});
  file_warnings_ = table.warnings;
  if (!links_.empty()) return;
  throw InputError(fmt::format("{}: none of its rows can be used ({} in all); the first: {}", links_path_,
                               bad_links_.size(), bad_links_.front().message));
}

viewshed::LinkStudy ZtvRadioOptions::study(const Zone& zone) const {
  viewshed::LinkStudy study{links_, frequency_ghz_, 0};
  for (const Turbine& t : zone.request.turbines)
    study.rotor_radius_m = std::max(study.rotor_radius_m, t.rotor_diameter.value_or(0) / 2);
  return study;
}

std::vector<viewshed::ZoneFile> ZtvRadioOptions::write(const std::string& folder, const Zone& zone,
                                                       const viewshed::ZoneFileOptions& options) const {
  std::vector<viewshed::ZoneFile> files = write_radar_raster(folder, zone, options);
  const auto links = write_link_raster(folder, zone, options, study(zone));
  files.insert(files.end(), links.begin(), links.end());
  return files;
}

ZtvRadioOptions::Nearest ZtvRadioOptions::nearest_link(const Turbine& turbine) const {
  Nearest nearest{"", std::numeric_limits<double>::infinity()};
  for (const viewshed::RadioLink& link : links_) {
    const double clearance =
        viewshed::link_clearance_m(link, turbine.position, frequency_ghz_, turbine.rotor_diameter.value_or(0) / 2);
    if (clearance < nearest.clearance) nearest = {link.id, clearance};
  }
  return nearest;
}

std::string ZtvRadioOptions::columns() const {
  std::string names;
  if (radar_) names += ",radar_visible_m";
  if (!links_.empty()) names += ",link,link_clearance_m,link_excluded";
  if (radar_) names += ",radar_sees";
  return names;
}

std::string ZtvRadioOptions::cells(const Zone& zone, std::size_t k) const {
  std::string text;
  const bool undecided = zone.radar && radar_leaves_open(*zone.radar, k);
  if (zone.radar) text += undecided ? "," : fmt::format(",{:.2f}", zone.radar->turbine_m[k]);
  if (!links_.empty()) {
    const Nearest nearest = nearest_link(zone.request.turbines[k]);
    text +=
        fmt::format(",{},{:.2f},{}", csv_cell(nearest.link), nearest.clearance, nearest.clearance < 0 ? "yes" : "no");
  }
  if (zone.radar) text += undecided ? ",undecided" : zone.radar->turbine_m[k] > 0 ? ",yes" : ",no";
  return text;
}

Document ZtvRadioOptions::document(const Zone& zone) const {
  Document document = Document::object();
  if (zone.radar) {
    document["radar"] = {{"ground_m", zone.radar->ground_m},
                         {"turbines_seen", seen_in(zone.radar->turbine_m)},
                         {"turbines_undecided", seen_in(zone.radar->undecided_turbine_m)}};
  }
  if (!links_.empty()) {
    const auto& turbines = zone.request.turbines;
    const auto excluded = std::count_if(turbines.begin(), turbines.end(),
                                        [&](const Turbine& t) { return nearest_link(t).clearance < 0; });
    document["links"] = bad_rows_document(links_path_, links_.size() + bad_links_.size(), links_.size(), bad_links_);
    document["links"].update(
        {{"links", links_.size()}, {"wavelength_m", wavelength_m(frequency_ghz_)}, {"turbines_excluded", excluded}});
  }
  return document;
}

std::vector<std::string> ZtvRadioOptions::methods(const Zone& zone) const {
  std::vector<std::string> paragraphs;
  if (zone.radar) {
    paragraphs.push_back(fmt::format(
        "## Radar\n\nA radar at {:.0f}, {:.0f}, {:g} m above its ground of {:.1f} m. `radar-height.tif` is the least "
        "height above the ground that it sees over bare ground, with curvature and refraction as stated; "
        "`turbines.csv` says how many metres of each turbine rise above its horizon. The heights are exact for the "
        "surface; between the "
        "terrain's points they depend on its triangles.",
        radar_->position.x, radar_->position.y, radar_->height, zone.radar->ground_m));
    if (zone.radar->leaves_open())
      paragraphs.back() += fmt::format(
          " Where ground without data alone could hide something from the radar, it is undecided whether that is seen: "
          "of {}, and from the heights of `radar-height-undecided.tif` on. What must stay out of the radar's sight has "
          "to stay below these, too; the option `{}` decides it.",
          counted(seen_in(zone.radar->undecided_turbine_m), "turbine"), kDecidesMissingGround);
  }
  if (!links_.empty()) {
    const double radius = study(zone).rotor_radius_m;
    const std::string rotor = radius > 0 ? fmt::format("the greatest rotor, {:g} m in radius", radius)
                                         : "the axis alone, as no rotor is known";
    paragraphs.push_back(fmt::format(
        "## Radio links\n\n{} of `{}` at {:g} GHz (wavelength 0.299792458 / f). After Bacon (2002) a rotor must stay "
        "out of the second Fresnel zone, of radius sqrt(2 lambda d1 d2 / d), in plan: `link-exclusion.tif` for {}; "
        "`turbines.csv` for each turbine's own. Heights are not taken into account, so that ground without data leaves "
        "nothing open.",
        counted(links_.size(), "link"), links_path_, frequency_ghz_, rotor));
  }
  return paragraphs;
}

std::vector<std::string> ZtvRadioOptions::warnings(const Zone& zone) const {
  if (links_.empty()) return {};
  std::vector<std::string> warnings = file_warnings_;
  for (const BadRow& bad : bad_links_) warnings.push_back(bad_row_warning(links_path_, bad));
  const auto& turbines = zone.request.turbines;
  const auto unknown =
      std::count_if(turbines.begin(), turbines.end(), [](const Turbine& t) { return !t.rotor_diameter; });
  if (unknown > 0)
    warnings.push_back(
        fmt::format("the rotor diameter is unknown for {}: links are kept clear of the axes of these alone",
                    counted(static_cast<std::uint64_t>(unknown), "turbine")));
  return warnings;
}

}  // namespace itin::cli
