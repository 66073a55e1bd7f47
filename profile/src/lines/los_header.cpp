#include "lines/los_header.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/crs_words.hpp>
#include <itin/feature_at.hpp>
#include <itin/geodesic.hpp>
#include <itin/grid_reference.hpp>
#include <itin/level_choice.hpp>
#include <itin/sources_in.hpp>
#include <itin/surface_text.hpp>
#include <profile/report_text.hpp>

#include "lines/line_sources.hpp"
#include "lines/magnetic_azimuth.hpp"

namespace itin::profile {

namespace {

void add_sites(const StoreLine& line, LosReport& report) {
  const CelestialBody body = body_of(report.crs_wkt);
  const CoordinateTransform to_geographic(report.crs_wkt, body.geographic_crs);
  const Point2 a = to_geographic(line.from), b = to_geographic(line.to);
  const Geodesic between = geodesic(a, b, body.ellipsoid);
  const auto site = [&](Point2 position, Point2 towards, Point2 lon_lat, double azimuth_deg, double elevation_m) {
    const std::optional<double> declination = declination_on(report.query.day, lon_lat, elevation_m);
    return LosEnd::Site{position,
                        lon_lat,
                        grid_azimuth_deg(position, towards),
                        azimuth_deg,
                        magnetic_azimuth_deg(azimuth_deg, declination),
                        declination};
  };
  report.from.site = site(line.from, line.to, a, between.azimuth_deg, report.antennas.from_m);
  report.to.site = site(line.to, line.from, b, between.back_azimuth_deg, report.antennas.to_m);
  report.geodesic_m = between.distance_m;
}

/// Names the features where the sight line is cut or tightest.
void name_features(const Store& store, LosReport& report) {
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
  if (report.lowest) want(report.lowest->theme, report.lowest->distance_m, report.lowest->feature);
  for (Obstruction& o : report.obstructions) want(o.theme, o.peak_at_m, o.feature);
  for (const auto& [theme, these] : wanted) {
    const auto found = features_at(store, theme, these.places);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      *these.features[i] = found[i]->number;
      report.features[{theme, found[i]->number}] = *found[i];
    }
  }
}

std::string names_in(const std::vector<std::string>& themes) {
  std::string names;
  for (const std::string& theme : themes) names += (names.empty() ? "" : ", ") + theme;
  return names.empty() ? "none" : names;
}

std::vector<std::pair<std::string, std::string>> facts_about(const Store& store, const StoreLine& line,
                                                             const std::vector<SourceInfo>& sources) {
  const StoreMetadata& metadata = store.metadata();
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Store", std::filesystem::path(store.path()).filename().string()}};
  for (const std::string& text : described(sources, metadata)) facts.emplace_back("Source", text);
  const std::string omitted = omitted_text(line.themes);
  facts.insert(facts.end(), {{"CRS", crs_in_full(metadata.crs_wkt)},
                             {"Surface", fmt::format("{}; themes: {}{}{}", surface_text(metadata, line.detail),
                                                     names_in(line.themes.names(metadata.themes)),
                                                     omitted.empty() ? "" : "; ", omitted)}});
  return facts;
}

std::string angle_text(double degrees) {
  return fmt::format("{:.3f}\xC2\xB0", degrees);
}

/// Writes degrees like 51°32'37.3"N.
std::string degrees_minutes_seconds(double degrees, char positive, char negative) {
  const auto tenths = static_cast<std::int64_t>(std::llround(std::abs(degrees) * 36000));
  return fmt::format("{}\xC2\xB0{:02}'{:02}.{}\"{}", tenths / 36000, tenths / 600 % 60, tenths / 10 % 60, tenths % 10,
                     degrees < 0 ? negative : positive);
}

/// A reference of the National Grid where the CRS is the National Grid, else of UTM.
std::string grid_reference(const LosEnd::Site& site, const std::string& crs_wkt) {
  const std::optional<std::string> reference =
      is_national_grid(crs_wkt) ? national_grid_reference(site.position) : utm_reference(site.lon_lat);
  return reference ? "; " + *reference : "";
}

std::string declination_text(const std::optional<double>& degrees) {
  if (!degrees) return "none so close to the magnetic pole";
  return fmt::format("{:.2f}\xC2\xB0 {}", std::abs(*degrees), *degrees < 0 ? "W" : "E");
}

/// Tells where the magnetic azimuths of a day come from, or why there are none.
std::string magnetic_fact(const LosReport& report, const CalendarDay& day) {
  if (!has_declination(day))
    return fmt::format("no azimuths from it, because the report is of {}; {}", day_text(day), magnetic_model_text());
  return fmt::format("declination {} at A, {} at B, on {}; {}", declination_text(report.from.site->declination_deg),
                     declination_text(report.to.site->declination_deg), day_text(day), magnetic_model_text());
}

/// Writes azimuths like "31.100° grid, 32.440° true, 33.1° magnetic". The last has no more digits
/// than its model justifies.
std::string azimuths_text(const LosEnd::Site& site) {
  const std::string text =
      fmt::format("{} grid, {} true", angle_text(site.azimuth_grid_deg), angle_text(site.azimuth_true_deg));
  return site.azimuth_magnetic_deg ? text + fmt::format(", {:.1f}\xC2\xB0 magnetic", *site.azimuth_magnetic_deg) : text;
}

std::vector<std::string> lines_about(const LosEnd& end, const std::string& crs, const std::string& crs_wkt) {
  const LosEnd::Site& site = *end.site;
  const bool on_earth = body_of(crs_wkt).is_earth;
  const std::string surface = end.on_surface ? fmt::format(", surface {:.2f} m", *end.surface_m) : "";
  return {
      fmt::format("{:.2f}, {:.2f} ({})", site.position.x, site.position.y, crs),
      fmt::format("{:.6f}\xC2\xB0 {}, {:.6f}\xC2\xB0 {}{}", std::abs(site.lon_lat.y), site.lon_lat.y < 0 ? "S" : "N",
                  std::abs(site.lon_lat.x), site.lon_lat.x < 0 ? "W" : "E", on_earth ? " (WGS 84)" : ""),
      degrees_minutes_seconds(site.lon_lat.y, 'N', 'S') + " " + degrees_minutes_seconds(site.lon_lat.x, 'E', 'W') +
          (on_earth ? grid_reference(site, crs_wkt) : ""),
      fmt::format("ground {:.2f} m{}, height {:.2f} m, elevation {:.2f} m", end.ground_m, surface, end.height_m,
                  end.elevation_m),
      fmt::format("azimuth {}; elevation angle {}", azimuths_text(site), angle_text(end.elevation_angle_deg))};
}

}  // namespace

void add_header(const Store& store, const StoreLine& line, LosReport& report) {
  const StoreMetadata& metadata = store.metadata();
  report.crs_wkt = metadata.crs_wkt;
  report.themes = theme_names(metadata);
  for (const ThemeInfo& theme : metadata.themes) report.theme_kinds.push_back(theme.kind);
  name_features(store, report);
  add_sites(line, report);
  report.sources = sources_under(store, line);
  report.facts = facts_about(store, line, report.sources);
  if (const auto& day = report.query.day) report.facts.emplace_back("Magnetic north", magnetic_fact(report, *day));
  const std::string crs = crs_in_short(metadata.crs_wkt);
  report.from_lines = lines_about(report.from, crs, metadata.crs_wkt);
  report.to_lines = lines_about(report.to, crs, metadata.crs_wkt);
}

}  // namespace itin::profile
