#include "options/places/observer_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/site_list.hpp>
#include <profile/antenna_columns.hpp>

#include "options/places/off_the_data.hpp"
#include "options/places/taken_heights.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

void ObserverOptions::declare(CLI::App& app) {
  begin_group(app, "Observers");
  app.add_option("--observer", observers_, "An observer; may be given again, or several in a row")
      ->type_name("x,y[,h]")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--observer-name", names_, "The name of an observer; as many as there are of --observer")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  reads(app.add_option("--observers", sites_.path,
                       "Observers from a vector file, or from CSV with columns x,y or lon,lat")
            ->type_name("FILE"));
  app.add_option("--layer", sites_.layer, "The layer of that file")->type_name("NAME");
  app.add_option("--where", sites_.where, "Only observers that this SQL condition holds for")->type_name("SQL");
  app.add_option("--height-field", sites_.height_field,
                 "The field of that file that holds h (default: height, unless --observer-height is given)")
      ->type_name("FIELD");
  app.add_option("--name-field", sites_.name_field, "The field of that file that holds names (default: name)")
      ->type_name("FIELD");
  app.add_option("--observer-height", height_text_, "Height h of observers that have none of their own (default: 2)")
      ->type_name("METRES");
  app.add_flag("--absolute-heights", absolute_heights_, "Every h is an elevation, not a height above the surface");
  app.add_flag("--observer-absolute", absolute_, "Heights of observers alone are elevations");
  app.add_option("--observer-on", observer_on_, "ground (default), or the surface with the roofs and tops of --themes")
      ->type_name("ground|surface");
  in_crs_.declare(app);
  views_.declare(app);
}

void ObserverOptions::validate() {
  if (observers_.empty() && sites_.path.empty())
    throw InputError("give observers by --observer x,y,h or by --observers FILE");
  if (!observers_.empty() && !sites_.path.empty())
    throw InputError("--observer and --observers exclude each other; give all observers in one way");
  if (!names_.empty() && names_.size() != observers_.size())
    throw InputError(fmt::format("--observer-name: {} given for {} of --observer; give one for each", names_.size(),
                                 observers_.size()));
  if (sites_.path.empty()) {
    const auto refuse = [](const std::string& value, const char* option) {
      if (!value.empty()) throw InputError(fmt::format("{} works only with --observers", option));
    };
    refuse(sites_.layer, "--layer");
    refuse(sites_.where, "--where");
    refuse(sites_.height_field, "--height-field");
    refuse(sites_.name_field, "--name-field");
    if (views_.given()) throw InputError("fields of observers work only with --observers");
  }
  views_.validate();
  if (views_.arcgis() && !sites_.height_field.empty())
    throw InputError("--arcgis-fields takes heights from OFFSETA; leave out --height-field");
  parse_choice("--observer-on", observer_on_, {"ground", "surface"});
  if (!height_text_.empty()) height_ = parse_height("--observer-height", height_text_);
  if (!height_text_.empty()) height_of("--observer-height", height_);
  for (const std::string& text : observers_) {
    given_.push_back(parse_place("--observer", text));
    height_of(fmt::format("--observer '{}'", text), given_.back().height);
  }
}

/// Returns the height of an observer: its own, or that of the call. Elevations have no default.
double ObserverOptions::height_of(const std::string& where, std::optional<double> own) const {
  const double height = own.value_or(height_);
  if (absolute() && !own && height_text_.empty())
    throw InputError(where + ": it has no elevation; give it one, or --observer-height");
  if (!absolute() && height < 0)
    throw InputError(where + ": a height must not be negative; for an elevation give --absolute-heights");
  return height;
}

std::vector<viewshed::Observer> ObserverOptions::observers(const StoreMetadata& metadata,
                                                           const viewshed::Request& request, bool target_height_given,
                                                           std::vector<std::string>& warnings) {
  if (sites_.path.empty()) return observers_given(metadata);
  const bool names_heights = views_.arcgis() || !sites_.height_field.empty();
  const LayerFields fields(sites_);
  if (!names_heights) {
    HeightChoice choice{height_text_.empty() ? "" : "--observer-height", "--height-field"};
    for (const NumberField& field : views_.numbers()) choice.used.push_back(field.name);
    take_heights(sites_, fields, choice, warnings);
  }
  took_heights_ = !names_heights && !sites_.height_field.empty();
  take_names(sites_, fields);
  if (!views_.reads_radii()) warn_of_unused(sites_, fields, "radius", "--radius-field", warnings);
  return observers_of_file(metadata, request, target_height_given, warnings);
}

Document ObserverOptions::parameters() const {
  Document parameters = Document::object();
  if (!sites_.height_field.empty()) parameters["height_field"] = sites_.height_field;
  if (!sites_.name_field.empty()) parameters["name_field"] = sites_.name_field;
  return parameters;
}

std::string ObserverOptions::text() const {
  return taken_heights_text("observers", took_heights_ ? sites_.height_field : "", sites_.path);
}

std::vector<viewshed::Observer> ObserverOptions::observers_given(const StoreMetadata& metadata) const {
  std::vector<viewshed::Observer> observers;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const std::string what = fmt::format("--observer '{}'", observers_[i]);
    observers.push_back({names_.empty() ? fmt::format("{}", i + 1) : names_[i],
                         on_the_data(what, given_[i], in_crs_, metadata), given_[i].height.value_or(height_),
                         absolute()});
  }
  return observers;
}

std::vector<viewshed::Observer> ObserverOptions::observers_of_file(const StoreMetadata& metadata,
                                                                   const viewshed::Request& request,
                                                                   bool target_height_given,
                                                                   std::vector<std::string>& warnings) const {
  SiteQuery query = sites_;
  query.crs = in_crs_.crs;
  query.numbers = views_.numbers();
  std::optional<profile::AntennaColumns> antennas;
  if (request.mode == viewshed::Mode::kLevel) antennas.emplace(query);
  std::vector<viewshed::Observer> observers;
  for (const Site& site : read_sites(query, metadata.crs_wkt, warnings)) {
    const std::string where = fmt::format("{}: {}", query.path, site.place);
    require_on_the_data(where, site.position, in_crs_, metadata);
    viewshed::Observer observer{site.name, site.position, site.height.value_or(height_), absolute()};
    views_.fill(observer, site.numbers, where);
    if (antennas) observer.antenna = antennas->of(site);
    views_.require_agreement(observer, request, where);
    if (!views_.arcgis()) height_of(where, site.height);
    if (request.target_absolute && !observer.target_height && !target_height_given)
      throw InputError(where + ": it has no elevation of its targets; give it one, or --target-height");
    observers.push_back(std::move(observer));
  }
  if (observers.empty()) throw InputError(none_in(query, "observer"));
  return observers;
}

Document observers_document(const std::vector<viewshed::Observer>& observers) {
  Document documents = Document::array();
  for (const viewshed::Observer& o : observers) {
    Document& document = documents.emplace_back(Document{{"name", o.name},
                                                         {"x", o.position.x},
                                                         {"y", o.position.y},
                                                         {o.absolute ? "elevation_m" : "height_m", o.height}});
    if (o.target_height) document["target_height_m"] = *o.target_height;
    if (o.radius) document["radius_m"] = *o.radius;
    if (o.min_radius) document["min_radius_m"] = *o.min_radius;
    if (o.azimuth) document["azimuth_deg"] = {o.azimuth->from, o.azimuth->to};
    if (o.elevation) document["elevation_deg"] = {o.elevation->from, o.elevation->to};
    if (o.antenna.azimuth_deg) document["antenna_azimuth_deg"] = *o.antenna.azimuth_deg;
    if (o.antenna.tilt_deg) document["antenna_tilt_deg"] = *o.antenna.tilt_deg;
  }
  return documents;
}

}  // namespace itin::cli
