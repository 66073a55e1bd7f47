#include "dwellings/dwellings_options.hpp"

#include <sstream>

#include <itin/error.hpp>

#include "options/places/off_the_data.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void DwellingsOptions::declare(CLI::App& app) {
  reads(app.add_option("STORE", store, "The store")->required());
  turbines_.declare(app);
  begin_group(app, "Dwellings");
  reads(
      app.add_option("--dwellings", places_,
                     "Dwellings from a vector file of points, or CSV with columns x,y or lon,lat. One that lies on a "
                     "building of --themes is that building with its facades, any other a place in the open (default: "
                     "all buildings of --themes)"))
      ->type_name("FILE");
  app.add_option("--dwelling-theme", request_.dwelling_theme,
                 "The theme whose buildings are dwellings (default: all of --themes)")
      ->type_name("NAME");
  app.add_option("--radius", radius_text_,
                 "Dwellings are studied up to this distance from a turbine, and wherever its shadow reaches (default: "
                 "2000)")
      ->type_name("METRES");
  app.add_option("--observer-height", observer_text_, "Height of eyes above the bare ground (default: 2)")
      ->type_name("METRES");
  flicker_.declare(app);
  begin_group(app, kOutputs);
  replaces(app.add_option("-o,--output", directory, "The folder to write")->type_name("DIR")->required());
  policy.declare(app);
  sheets_.declare(app,
                  "A sheet for each dwelling, with a map, what its facades see and a calendar of its shadow "
                  "flicker, as PDF and PNG on A3, A1 or both (default: none)");
  app.add_option("--sheets-of", sheets_of_text_,
                 "Sheets only of the dwellings with these names or ids, or of these rows of dwellings.csv")
      ->type_name("NAME,NAME");
  themes_.declare(app);
  foliage_.declare_of_seasons(app);
  earth_.declare(app);
  nodata_.declare(app);
  memory_.declare(app,
                  "Memory to work in, for example 2G. Surfaces that exceed it are read in parts; the result does not "
                  "depend on it (default: 1G)");
}

void DwellingsOptions::validate() {
  turbines_.validate();
  flicker_.validate();
  themes_.validate();
  foliage_.validate();
  if (foliage_.given()) request_.foliage = {foliage_.foliage().extinction, foliage_.foliage().least_transmittance};
  earth_.validate();
  sheets_.validate(true);
  if (!sheets_of_text_.empty() && !sheets_.given()) throw InputError("--sheets-of works only with --sheets");
  std::istringstream names(sheets_of_text_);
  for (std::string name; std::getline(names, name, ',');) sheets_of_.push_back(name);
  request_.flicker = flicker_.rules();
  request_.nodata = nodata_.rule();
  request_.memory_bytes = memory_.bytes().value_or(request_.memory_bytes);
  if (!radius_text_.empty()) request_.radius = parse_radius("--radius", radius_text_);
  if (!observer_text_.empty())
    request_.eye_height = parse_height("--observer-height", observer_text_, Range::kNotNegative);
}

viewshed::DwellingsRequest DwellingsOptions::complete_request(const Store& read, Progress& progress) {
  const StoreMetadata& metadata = read.metadata();
  earth_.take_body_of(metadata);
  request_.earth = earth_.earth();
  themes_.choice().check(metadata.themes);
  themes_.complete(read, progress);
  request_.themes = themes_.choice();
  request_.turbines = turbines_.read({.fixed = request_.radius}, metadata);
  if (!places_.empty()) read_places(metadata);
  return request_;
}

void DwellingsOptions::read_places(const StoreMetadata& metadata) {
  request_.dwellings = viewshed::read_dwellings(places_, turbines_.in_crs().crs, metadata.crs_wkt);
  std::vector<Point2> positions;
  for (const viewshed::SitePlace& place : request_.dwellings.places) positions.push_back(place.position);
  require_any_on_the_data(places_ + ": the first dwelling", positions, turbines_.in_crs(), metadata);
}

Document DwellingsOptions::parameters() const {
  Document p{{"store", store}};
  p.update(turbines_.parameters());
  if (!places_.empty()) p["dwellings"] = places_;
  if (!request_.dwelling_theme.empty()) p["dwelling_theme"] = request_.dwelling_theme;
  p["radius_m"] = request_.radius;
  p["observer_height_m"] = request_.eye_height;
  p.update(flicker_.parameters());
  p.update(themes_.parameters());
  p.update(foliage_.parameters());
  p["nodata"] = nodata_.text();
  p.update(sheets_.parameters());
  if (!sheets_of_.empty()) p["sheets_of"] = sheets_of_;
  return p;
}

}  // namespace itin::cli
