#include "los/los_store.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/foliage_text.hpp>
#include <profile/report_text.hpp>

#include "options/places/off_the_data.hpp"
#include "output/store_document.hpp"
#include "program/help.hpp"
#include "program/unusable_options.hpp"

namespace itin::cli {

namespace {

std::vector<std::string> warnings_about(const profile::LosReport& report) {
  std::vector<std::string> warnings;
  const std::string gaps = gap_text(report, profile::DistanceUnit::kMetres);
  if (!gaps.empty() && report.query.nodata != profile::NoData::kClear) warnings.push_back(gaps + "; see --nodata");
  if (report.query.radio && !report.losses && report.profile.has_length())
    warnings.emplace_back(
        "an antenna is inside something that stands on the ground, so that no losses are given; raise it, or see "
        "--observer-on and --target-on");
  return warnings;
}

}  // namespace

void LosStoreOptions::declare(CLI::App& app) {
  begin_group(app, "The line");
  app_ = &app;
  app.add_option(
         "--from", from_text_,
         "The first end; h is 2 where not given. For x,y also degrees with N, S, E or W, or an OS grid reference")
      ->type_name("x,y[,h]");
  app.add_option("--to", to_text_, "The second end; h is 2 where not given")->type_name("x,y[,h]");
  app.add_flag("--absolute-heights", absolute_heights_, "Every h is an elevation, not a height above the surface");
  app.add_flag("--observer-absolute", from_absolute_, "The first end's h alone is an elevation");
  app.add_flag("--target-absolute", to_absolute_, "The second end's h alone is an elevation");
  app.add_option("--observer-on", from_on_,
                 "What the first end stands on: ground (default), or the surface with the roofs and tops of --themes")
      ->type_name("ground|surface");
  app.add_option("--target-on", to_on_, "What the second end stands on: ground (default) or surface")
      ->type_name("ground|surface");
  in_crs_.declare(app);
  detail_.declare(app, "--from");
  themes_.declare(app);
  foliage_.declare(app);
  nodata_.declare(app);
}

void LosStoreOptions::declare_memory(CLI::App& app) {
  memory_.declare(app, kKeptOfTheStore);
}

void LosStoreOptions::require_none() const {
  if (given()) throw InputError("--from and --to need a STORE; with --profile-csv give --heights h1,h2");
  require_not_given(*app_,
                    {"--absolute-heights", "--observer-absolute", "--target-absolute", "--observer-on", "--target-on",
                     "--in-crs", "--tolerance", "--rings", "--themes", "--without", "--foliage", "--leaf-area",
                     "--transmittance", "--nodata", "--memory"},
                    "works only with a STORE");
}

void LosStoreOptions::validate(std::optional<double> object_tip_m) {
  if (from_text_.empty() || to_text_.empty()) throw InputError("give both ends: --from x,y,h --to x,y,h");
  from_ = parse_place("--from", from_text_);
  to_ = parse_place("--to", to_text_);
  if (absolute_heights_ && !(from_.height && to_.height)) {
    throw InputError("--absolute-heights: give both ends' elevations, x,y,h");
  }
  if (from_absolute_ && !from_.height) throw InputError("--observer-absolute: give the elevation at --from, x,y,h");
  if (to_absolute_ && !to_.height) throw InputError("--target-absolute: give the elevation at --to, x,y,h");
  from_height_ = from_.height.value_or(2);
  to_height_ = to_.height.value_or(object_tip_m.value_or(2));
  validate_choices();
  if ((!from_is_elevation() && from_height_ < 0) || (!to_is_elevation() && to_height_ < 0)) {
    throw InputError("--from, --to: a height must not be negative; for an elevation give --absolute-heights");
  }
}

void LosStoreOptions::validate_choices() {
  nodata_.rule();
  memory_.bytes();
  parse_choice("--observer-on", from_on_, {"ground", "surface"});
  parse_choice("--target-on", to_on_, {"ground", "surface"});
  detail_.validate();
  themes_.validate();
  foliage_.validate();
}

void LosStoreOptions::validate_surface() {
  validate_choices();
  if (foliage_.given()) throw InputError("--foliage is for one line between --from and --to, not for --links");
  if (detail_.has_rings()) throw InputError("--rings have no one centre for many links; give --tolerance");
  for (const auto& [given, option] :
       {std::pair(absolute_heights_, "--absolute-heights"), std::pair(from_absolute_, "--observer-absolute"),
        std::pair(to_absolute_, "--target-absolute")})
    if (given) throw InputError(fmt::format("{} is not for --links, whose heights are above the ground", option));
}

Document LosStoreOptions::surface_parameters() const {
  Document parameters = detail_.parameters();
  parameters.update(themes_.parameters());
  parameters.update(foliage_.parameters());
  parameters["observer_on"] = from_on_;
  parameters["target_on"] = to_on_;
  if (!in_crs_.crs.empty()) parameters["in_crs"] = in_crs_.crs;
  parameters["nodata"] = nodata_.text();
  return parameters;
}

Document LosStoreOptions::parameters() const {
  const auto end = [](const Place& place, double height, bool is_elevation) {
    Document document{
        {"x", place.position.x}, {"y", place.position.y}, {is_elevation ? "elevation_m" : "height_m", height}};
    if (!place.crs.empty()) document["crs"] = place.crs;
    return document;
  };
  Document parameters{{"from", end(from_, from_height_, from_is_elevation())},
                      {"to", end(to_, to_height_, to_is_elevation())}};
  parameters.update(surface_parameters());
  return parameters;
}

LosStoreOptions::Result LosStoreOptions::run(const Store& store, profile::LosQuery query) const {
  const auto end = [&](const char* option, const std::string& text, const Place& place) {
    return on_the_data(fmt::format("{} '{}'", option, text), place, in_crs_, store.metadata());
  };
  const Ends ends{end("--from", from_text_, from_), end("--to", to_text_, to_), from_height_, to_height_};
  return run(store, std::move(query), ends);
}

LosStoreOptions::Result LosStoreOptions::run(const Store& store, profile::LosQuery query, const Ends& ends) const {
  const profile::StoreLine line{ends.from,           ends.to,          detail_.detail(ends.from), themes(),
                                from_is_elevation(), to_is_elevation()};
  query.from_height_m = ends.from_height, query.to_height_m = ends.to_height;
  query.from_on_surface = from_on_surface(), query.to_on_surface = to_on_surface();
  query.nodata = nodata();
  Result result;
  result.line = line;
  if (foliage_.given()) {
    profile::FoliageSight sight = profile::through_foliage(store, line, query, foliage_.foliage());
    result.foliage = profile::foliage_document(sight, foliage_.foliage());
    result.foliage_text = profile::foliage_text(sight, foliage_.foliage());
    result.report = profile::report_through(std::move(sight), foliage_.foliage());
  } else {
    result.report = profile::analyse(store, line, query);
  }
  result.warnings = warnings_about(result.report);
  return result;
}

}  // namespace itin::cli
