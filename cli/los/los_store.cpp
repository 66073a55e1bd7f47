#include "los/los_store.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/geodesic.hpp>
#include <profile/clearance_error.hpp>

#include "options/off_the_data.hpp"
#include "output/store_document.hpp"

namespace itin::cli {

namespace {

double grid_azimuth_deg(Point2 from, Point2 to) {
  const double degrees = std::atan2(to.x - from.x, to.y - from.y) * 180 / std::numbers::pi;
  return degrees < 0 ? degrees + 360 : degrees;
}

/// Each with its direction to the other, and their distance on the ellipsoid.
struct Sites {
  LosEnd::Site from, to;
  double geodesic_m = 0;
};

Sites sites(Point2 from, Point2 to, const std::string& crs_wkt) {
  const CoordinateTransform to_geographic(crs_wkt, "EPSG:4326");
  const Point2 a = to_geographic(from), b = to_geographic(to);
  const Geodesic line = geodesic(a, b);
  return {{from, a, grid_azimuth_deg(from, to), line.azimuth_deg},
          {to, b, grid_azimuth_deg(to, from), line.back_azimuth_deg},
          line.distance_m};
}

std::string angle(double degrees) {
  return fmt::format("{:.3f}\xC2\xB0", degrees);
}

std::vector<std::string> lines_about(const LosEnd& end, const std::string& crs) {
  const LosEnd::Site& site = *end.site;
  const std::string surface = end.on_surface ? fmt::format(", surface {:.2f} m", *end.surface_m) : "";
  return {fmt::format("{:.2f}, {:.2f} ({})", site.position.x, site.position.y, crs),
          fmt::format("{:.6f}\xC2\xB0 {}, {:.6f}\xC2\xB0 {} (WGS 84)", std::abs(site.lon_lat.y),
                      site.lon_lat.y < 0 ? "S" : "N", std::abs(site.lon_lat.x), site.lon_lat.x < 0 ? "W" : "E"),
          fmt::format("ground {:.2f} m{}, height {:.2f} m, elevation {:.2f} m", end.ground_m, surface, end.height_m,
                      end.elevation_m()),
          fmt::format("azimuth {} grid, {} true; elevation angle {}", angle(site.azimuth_grid_deg),
                      angle(site.azimuth_true_deg), angle(end.elevation_angle_deg))};
}

std::string names_in(const Document& themes) {
  std::string names;
  for (const Document& theme : themes) names += (names.empty() ? "" : ", ") + theme.get<std::string>();
  return names.empty() ? "none" : names;
}

std::vector<std::pair<std::string, std::string>> facts_about(const Store& store, const Document& surface) {
  const StoreMetadata& metadata = store.metadata();
  std::string sources;
  for (const SourceInfo& source : metadata.sources) {
    if (sources.size() > 160) {
      sources += ", ...";
      break;
    }
    sources +=
        fmt::format("{}{}{}", sources.empty() ? "" : ", ", std::filesystem::path(source.path).filename().string(),
                    source.sha256.empty() ? "" : " (SHA-256 " + source.sha256.substr(0, 12) + ")");
  }
  return {{"Store", std::filesystem::path(store.path()).filename().string()},
          {"Sources", sources},
          {"CRS", fmt::format("{} ({})", crs_title(metadata.crs_wkt), crs_identifier(metadata.crs_wkt))},
          {"Surface",
           fmt::format("tolerance {:g} m, certified error {:+.2f} to {:+.2f} m; themes: {}",
                       surface.at("tolerance_m").get<double>(), surface.at("certified_error_m").at(0).get<double>(),
                       surface.at("certified_error_m").at(1).get<double>(), names_in(surface.at("themes")))}};
}

/// The themes by number, and the features where the sight line is cut or tightest.
void name_features(const Store& store, profile::LosReport& report) {
  report.themes = theme_names(store.metadata());
  struct Wanted {
    std::vector<Point2> places;
    std::vector<std::int64_t*> features;
  };
  std::map<std::uint16_t, Wanted> wanted;
  const auto want = [&](std::uint16_t theme, double distance_m, std::int64_t& feature) {
    if (theme == 0) return;
    wanted[theme].places.push_back(position_at(report, distance_m));
    wanted[theme].features.push_back(&feature);
  };
  if (report.critical) want(report.critical->theme, report.critical->distance_m, report.critical->feature);
  for (profile::Obstruction& o : report.obstructions) want(o.theme, o.peak_at_m, o.feature);
  for (const auto& [theme, these] : wanted) {
    const auto found = features_at(store, theme, these.places);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      *these.features[i] = found[i]->number;
      report.features[{theme, found[i]->number}] = found[i]->name;
    }
  }
}

}  // namespace

void LosStoreOptions::declare(CLI::App& app) {
  app.add_option("--from", from_text_, "The first end; h is 2 where not given")->type_name("x,y[,h]");
  app.add_option("--to", to_text_, "The second end; h is 2 where not given")->type_name("x,y[,h]");
  app.add_flag("--absolute-heights", absolute_heights_, "Every h is an elevation, not a height above the surface");
  app.add_option("--observer-on", from_on_,
                 "What the first end stands on: ground (default), or the surface with the roofs and tops of --themes")
      ->type_name("ground|surface");
  app.add_option("--target-on", to_on_, "What the second end stands on, likewise")->type_name("ground|surface");
  in_crs_.declare(app);
  detail_.declare(app);
  themes_.declare(app);
  app.add_option("--nodata", nodata_text_, "What ground without data does to the sight line (default: unknown)")
      ->type_name("unknown|block|clear");
}

void LosStoreOptions::validate(std::optional<double> object_tip_m) {
  if (from_text_.empty() || to_text_.empty()) throw InputError("give both ends: --from x,y,h --to x,y,h");
  from_ = parse_place("--from", from_text_);
  to_ = parse_place("--to", to_text_);
  if (absolute_heights_ && !(from_.height && to_.height)) {
    throw InputError("--absolute-heights: give both ends' elevations, x,y,h");
  }
  from_height_ = from_.height.value_or(2);
  to_height_ = to_.height.value_or(object_tip_m.value_or(2));
  parse_choice("--observer-on", from_on_, {"ground", "surface"});
  parse_choice("--target-on", to_on_, {"ground", "surface"});
  if (!nodata_text_.empty()) parse_choice("--nodata", nodata_text_, {"unknown", "block", "clear"});
  detail_.validate();
  themes_.validate();
  if (!absolute_heights_ && (from_height_ < 0 || to_height_ < 0)) {
    throw InputError("--from, --to: a height must not be negative; for an elevation give --absolute-heights");
  }
}

void LosStoreOptions::validate_surface() {
  if (!nodata_text_.empty()) parse_choice("--nodata", nodata_text_, {"unknown", "block", "clear"});
  detail_.validate();
  themes_.validate();
  parse_choice("--observer-on", from_on_, {"ground", "surface"});
  parse_choice("--target-on", to_on_, {"ground", "surface"});
  if (detail_.has_rings()) throw InputError("--rings have no one centre for many links; give --tolerance");
  if (absolute_heights_) throw InputError("--absolute-heights is not for --links, whose heights are above the ground");
}

Document LosStoreOptions::surface_parameters() const {
  Document parameters = detail_.parameters();
  parameters.update(themes_.parameters());
  parameters["observer_on"] = from_on_;
  parameters["target_on"] = to_on_;
  if (!in_crs_.crs.empty()) parameters["in_crs"] = in_crs_.crs;
  parameters["nodata"] = nodata_text_.empty() ? "unknown" : nodata_text_;
  return parameters;
}

Document LosStoreOptions::parameters() const {
  const auto end = [&](const Place& place, double height) {
    return Document{
        {"x", place.position.x}, {"y", place.position.y}, {absolute_heights_ ? "elevation_m" : "height_m", height}};
  };
  Document parameters{{"from", end(from_, from_height_)}, {"to", end(to_, to_height_)}};
  parameters.update(surface_parameters());
  return parameters;
}

double LosStoreOptions::height_above(const char* option, double ground_m, double given_m) const {
  if (!absolute_heights_) return given_m;
  if (given_m < ground_m) {
    throw InputError(
        fmt::format("{}: elevation {:g} m is below what it stands on, {:.2f} m", option, given_m, ground_m));
  }
  return given_m - ground_m;
}

LosStoreOptions::Result LosStoreOptions::run(const Store& store, profile::LosQuery query) const {
  const auto end = [&](const char* option, const std::string& text, const Place& place) {
    return on_the_data(fmt::format("{} '{}'", option, text), place.position, in_crs_, store.metadata());
  };
  const Ends ends{end("--from", from_text_, from_), end("--to", to_text_, to_), from_height_, to_height_};
  return run(store, std::move(query), ends);
}

LosStoreOptions::Result LosStoreOptions::run(const Store& store, profile::LosQuery query, const Ends& ends) const {
  const StoreMetadata& metadata = store.metadata();
  const auto& [from, to, from_height, to_height] = ends;
  const Detail detail = detail_.detail(from);
  const ThemeChoice& themes = themes_.choice();
  CrossSection section = cross_section(store, from, to, detail, themes);
  profile::Profile line = profile::from_section(section), ground;
  if (themes.includes_standing(metadata.themes)) {
    const CrossSection bare = cross_section(store, from, to, detail);
    ground = profile::from_section(bare);
    section.statistics += bare.statistics;
  }
  const auto require_ground = [&](const char* option, Point2 p, bool present) {
    if (!present) throw InputError(fmt::format("{}: there is no ground at {:.2f},{:.2f}", option, p.x, p.y));
  };
  const bool empty = line.points.empty();
  require_ground("--from", from, !empty && line.points.front().distance_m == 0);
  require_ground("--to", to, !empty && line.points.back().distance_m == line.length_m);
  query.from_on_surface = from_on_ == "surface", query.to_on_surface = to_on_ == "surface";
  const profile::EndGrounds stands_on = profile::stands_on(line, ground, query);
  query.from_height_m = height_above("--from", stands_on.from_m, from_height);
  query.to_height_m = height_above("--to", stands_on.to_m, to_height);
  query.clearance_error_m = profile::clearance_error(store, detail, themes, from, to);
  query.gaps_block = nodata_text_ == "block";

  Result result;
  result.surface = surface_document(metadata, detail, themes);
  if (!line.gaps.empty() && nodata_text_ != "clear") {
    result.warnings.push_back(fmt::format("the line crosses ground without data {}, which {}; see gaps, --nodata",
                                          line.gaps.size() == 1 ? "once" : fmt::format("{} times", line.gaps.size()),
                                          query.gaps_block ? "blocks it" : "counts as clear"));
  }
  result.report = profile::analyse(std::move(line), query, std::move(ground));
  profile::LosReport& report = result.report;
  report.crs_wkt = metadata.crs_wkt;
  name_features(store, report);
  if (query.radio && !report.losses && report.profile.has_length()) {
    result.warnings.emplace_back("an antenna is within a feature; no losses are given");
  }
  auto [from_site, to_site, geodesic_m] = sites(from, to, metadata.crs_wkt);
  report.geodesic_m = geodesic_m;
  const profile::EndGrounds bare = report.ground.points.empty() ? stands_on : profile::ends_of(report.ground);
  const profile::EndGrounds top = profile::ends_of(report.profile);
  result.from = {bare.from_m, query.from_height_m,   report.elevation_angle_from_deg,
                 top.from_m,  query.from_on_surface, from_site};
  result.to = {bare.to_m, query.to_height_m, report.elevation_angle_to_deg, top.to_m, query.to_on_surface, to_site};
  report.facts = facts_about(store, result.surface);
  const std::string crs = crs_identifier(metadata.crs_wkt);
  report.from_lines = lines_about(result.from, crs);
  report.to_lines = lines_about(result.to, crs);
  result.statistics = section.statistics;
  result.triangles = section.triangles;
  return result;
}

}  // namespace itin::cli
