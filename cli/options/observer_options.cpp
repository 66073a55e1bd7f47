#include "options/observer_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

#include "options/off_the_data.hpp"
#include "options/site_list.hpp"
#include "program/call_files.hpp"

namespace itin::cli {

void ObserverOptions::declare(CLI::App& app) {
  app.add_option("--observer", observers_, "An observer; may be given again, or several in a row")
      ->type_name("x,y[,h]")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  reads(app.add_option("--observers", sites_.path,
                       "Observers from a vector file, or from CSV with columns x,y or lon,lat")
            ->type_name("FILE"));
  app.add_option("--layer", sites_.layer, "The layer of that file")->type_name("NAME");
  app.add_option("--where", sites_.where, "Only observers that this SQL condition holds for")->type_name("SQL");
  app.add_option("--height-field", sites_.height_field, "The field of that file that holds h")->type_name("FIELD");
  app.add_option("--name-field", sites_.name_field, "The field of that file that holds names")->type_name("FIELD");
  app.add_option("--observer-height", height_text_, "h of observers that have none of their own (default: 2)")
      ->type_name("METRES");
  app.add_flag("--absolute-heights", absolute_heights_, "Every h is an elevation, not a height above the surface");
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
  if (sites_.path.empty()) {
    const auto refuse = [](const std::string& value, const char* option) {
      if (!value.empty()) throw InputError(fmt::format("{} is of use with --observers only", option));
    };
    refuse(sites_.layer, "--layer");
    refuse(sites_.where, "--where");
    refuse(sites_.height_field, "--height-field");
    refuse(sites_.name_field, "--name-field");
    if (views_.given()) throw InputError("fields of observers are of use with --observers only");
  }
  views_.validate();
  if (views_.arcgis() && !sites_.height_field.empty())
    throw InputError("--arcgis-fields takes heights from OFFSETA; leave out --height-field");
  parse_choice("--observer-on", observer_on_, {"ground", "surface"});
  if (!height_text_.empty()) height_ = parse_height("--observer-height", height_text_);
  require_above_ground("--observer-height", height_);
  for (const std::string& text : observers_) {
    given_.push_back(parse_place("--observer", text));
    require_above_ground(fmt::format("--observer '{}'", text), given_.back().height.value_or(height_));
  }
}

void ObserverOptions::require_above_ground(const std::string& where, double height) const {
  if (!absolute_heights_ && height < 0) {
    throw InputError(where + ": a height must not be negative; for an elevation give --absolute-heights");
  }
}

std::vector<ObserverPlace> ObserverOptions::places(const StoreMetadata& metadata) const {
  return sites_.path.empty() ? places_given(metadata) : places_of_file(metadata);
}

std::vector<ObserverPlace> ObserverOptions::places_given(const StoreMetadata& metadata) const {
  std::vector<ObserverPlace> places;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const std::string what = fmt::format("--observer '{}'", observers_[i]);
    places.push_back({fmt::format("{}", i + 1),
                      on_the_data(what, given_[i], in_crs_, metadata),
                      given_[i].height.value_or(height_),
                      absolute_heights_,
                      {}});
  }
  return places;
}

std::vector<ObserverPlace> ObserverOptions::places_of_file(const StoreMetadata& metadata) const {
  SiteQuery query = sites_;
  query.crs = in_crs_.crs;
  query.numbers = views_.numbers();
  std::vector<ObserverPlace> places;
  for (const Site& site : read_sites(query, metadata.crs_wkt)) {
    const std::string where = fmt::format("{}: feature {}", query.path, site.feature);
    require_on_the_data(where, site.position, in_crs_, metadata);
    ObserverPlace place{site.name, site.position, site.height.value_or(height_), absolute_heights_,
                        views_.view(site.numbers, where)};
    if (place.view.height) place.height = *place.view.height;
    if (place.view.spot) place.height += *place.view.spot, place.absolute = true;
    if (!place.absolute) require_above_ground(where, place.height);
    places.push_back(std::move(place));
  }
  if (places.empty()) throw InputError(none_in(query, "observer"));
  return places;
}

Document observers_document(const std::vector<ObserverPlace>& places) {
  Document observers = Document::array();
  for (const ObserverPlace& place : places) {
    Document observer{{"name", place.name},
                      {"x", place.position.x},
                      {"y", place.position.y},
                      {place.absolute ? "elevation_m" : "height_m", place.height}};
    add_view(place.view, observer);
    observers.push_back(std::move(observer));
  }
  return observers;
}

}  // namespace itin::cli
