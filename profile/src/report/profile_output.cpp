#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <itin/paths.hpp>
#include <itin/table_columns.hpp>
#include <profile/chart.hpp>
#include <profile/documents.hpp>
#include <profile/foliage_text.hpp>
#include <profile/path_profiles.hpp>
#include <profile/profile_text.hpp>

namespace itin::profile {

namespace {

struct PointOfSurface {
  const SurfaceProfile* surface;
  const ProfilePoint* point;
};

std::string profiles_csv(const PathProfiles& all) {
  using Row = const PointOfSurface&;
  const std::vector<std::string> themes = theme_names(all.metadata);
  std::vector<TableColumn<PointOfSurface>> columns{{"distance", [](Row r) { return r.point->distance_m; }},
                                                   {"x", [](Row r) { return r.point->x; }},
                                                   {"y", [](Row r) { return r.point->y; }},
                                                   {"z", [](Row r) { return r.point->ground_m; }},
                                                   {"theme", [&](Row r) { return themes[r.point->theme]; }}};
  if (all.profiles.size() > 1)
    columns.insert(columns.begin(), {"tolerance", [](Row r) { return r.surface->detail.coarsest(); }});
  std::vector<PointOfSurface> rows;
  for (const SurfaceProfile& surface : all.profiles)
    for (const ProfilePoint& point : surface.profile.points) rows.push_back({&surface, &point});
  return csv_of(columns, rows);
}

/// Lines over ground without gaps, of one theme; single points are left out.
Document lines_of(const Profile& profile, std::uint16_t theme) {
  const auto place = [&](std::size_t i) {
    const ProfilePoint& p = profile.points[i];
    return Document{p.x, p.y, p.ground_m};
  };
  Document lines = Document::array();
  bool open = false;
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const bool wanted = profile.joined(i) && profile.theme_between(i) == theme;
    if (wanted && !open) lines.push_back(Document::array({place(i)}));
    if (wanted) lines.back().push_back(place(i + 1));
    open = wanted;
  }
  return lines;
}

/// The terrain, and the themes that the profile meets.
std::set<std::uint16_t> themes_of(const Profile& profile) {
  std::set<std::uint16_t> themes{0};
  for (const ProfilePoint& p : profile.points) themes.insert(p.theme);
  return themes;
}

/// The CRS by an authority's code: "EPSG:27700". Throws InputError for one that has none.
std::string crs_code(const std::string& crs_wkt) {
  const std::string crs = crs_identifier(crs_wkt);
  if (crs.find(':') == std::string::npos || crs.size() > 32)
    throw InputError("the store's CRS has no authority code, which .geojson needs; write .csv or .json");
  return crs;
}

std::string profiles_geojson(const PathProfiles& all) {
  const std::string crs = crs_code(all.metadata.crs_wkt);
  const std::size_t colon = crs.find(':');
  Document document{{"type", "FeatureCollection"}, {"name", "profile"}};
  const std::string urn = fmt::format("urn:ogc:def:crs:{}::{}", crs.substr(0, colon), crs.substr(colon + 1));
  document["crs"] = {{"type", "name"}, {"properties", {{"name", urn}}}};
  document["features"] = Document::array();
  const std::vector<std::string> names = theme_names(all.metadata);
  for (const SurfaceProfile& surface : all.profiles) {
    for (const std::uint16_t theme : themes_of(surface.profile)) {
      Document feature{{"type", "Feature"}};
      feature["properties"] = {{"tolerance_m", surface.detail.coarsest()},
                               {"length_m", surface.profile.length_m},
                               {"theme", names[theme]},
                               {"gaps", gaps_document(surface.profile)}};
      feature["geometry"] = {{"type", "MultiLineString"}, {"coordinates", lines_of(surface.profile, theme)}};
      document["features"].push_back(std::move(feature));
    }
  }
  return json_text(document) + "\n";
}

std::string text_of(const PathProfiles& all) {
  std::vector<ThemeKind> kinds;
  for (const ThemeInfo& theme : all.metadata.themes) kinds.push_back(theme.kind);
  return profile_text(all.profiles.front().profile, all.ground, kinds);
}

/// The distances at which the path turns.
std::vector<double> turns_of(const PathProfiles& all) {
  const std::vector<double> along = distances_along(all.query.corners);
  return {along.begin() + 1, along.end() - 1};
}

std::string title_of(const PathProfiles& all) {
  const Point2 a = all.query.corners.front(), b = all.query.corners.back();
  const std::size_t turns = all.query.corners.size() - 2;
  const std::string line = fmt::format("Profile from {:.10g}, {:.10g} to {:.10g}, {:.10g}", a.x, a.y, b.x, b.y);
  return turns == 0 ? line : fmt::format("{} with {} corner{}", line, turns, turns > 1 ? "s" : "");
}

std::string profiles_chart(const PathProfiles& all, const std::string& title, const std::string& path) {
  Chart chart;
  chart.title = title.empty() ? title_of(all) : title;
  chart.corners_m = turns_of(all);
  chart.note = fmt::format("{}; {}; itin {}", std::filesystem::path(all.store).filename().string(),
                           crs_title(all.metadata.crs_wkt), ITIN_VERSION);
  if (const auto& foliage = all.profiles.front().foliage) chart.note = foliage_text(*foliage) + "; " + chart.note;
  for (const SurfaceProfile& surface : all.profiles) chart.series.push_back({surface.name, surface.profile});
  chart.ground = all.ground;
  chart.themes = theme_names(all.metadata);
  return draw_chart(chart, path);
}

std::string profile_bytes(const PathProfiles& all, const std::string& path, const ProfileFileOptions& options) {
  const std::string ending = ending_of(path);
  if (ending == ".csv") return profiles_csv(all);
  if (ending == ".json")
    return options.json.empty() ? json_of(all.metadata, all.query.themes, all.profiles) : options.json;
  if (ending == ".geojson") return profiles_geojson(all);
  if (ending == ".txt") return text_of(all);
  return profiles_chart(all, options.title, path);
}

}  // namespace

void require_profile_format(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* known : {".csv", ".txt", ".json", ".geojson", ".svg", ".pdf", ".png"}) {
    if (ending == known) return;
  }
  throw InputError(
      fmt::format("`output` '{}': a profile ends in .csv, .txt, .json, .geojson, .svg, .pdf or .png", path), "output");
}

void require_profile_crs(const std::string& path, const std::string& crs_wkt) {
  if (ending_of(path) == ".geojson") crs_code(crs_wkt);
}

void require_profile_output(const PathProfiles& profiles, const std::string& path) {
  require_profile_format(path);
  if (ending_of(path) != ".txt") return;
  const std::string name = fmt::format("`output` '{}'", path);
  if (profiles.profiles.size() > 1)
    throw InputError(name + ": a .txt holds one profile; give one `tolerance`", "details");
  require_profile_text(profiles.profiles.front().profile, name);
}

void write_profiles(const PathProfiles& profiles, const std::string& path, const ProfileFileOptions& options) {
  require_profile_output(profiles, path);
  write_file(path, profile_bytes(profiles, path, options), options.overwrite);
}

}  // namespace itin::profile
