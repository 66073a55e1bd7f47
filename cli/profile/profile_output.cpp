#include "profile/profile_output.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/output_file.hpp>
#include <profile/chart.hpp>
#include <profile/documents.hpp>
#include <profile/profile_text.hpp>

#include "output/output_path.hpp"
#include "output/store_document.hpp"

namespace itin::cli {

namespace {

using profile::Profile;
using profile::ProfilePoint;

std::string csv(const std::vector<SurfaceProfile>& profiles, const StoreMetadata& metadata) {
  const bool several = profiles.size() > 1;
  const std::vector<std::string> themes = profile::theme_names(metadata);
  std::string text = several ? "tolerance,distance,x,y,z,theme\n" : "distance,x,y,z,theme\n";
  const auto out = std::back_inserter(text);
  for (const SurfaceProfile& surface : profiles) {
    for (const ProfilePoint& p : surface.profile.points) {
      if (several) fmt::format_to(out, "{},", surface.detail.coarsest());
      fmt::format_to(out, "{},{},{},{},{}\n", p.distance_m, p.x, p.y, p.ground_m, themes[p.theme]);
    }
  }
  return text;
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

std::string geojson(const ProfileOutput& output) {
  const std::string crs = crs_identifier(output.metadata.crs_wkt);
  const std::size_t colon = crs.find(':');
  if (colon == std::string::npos || crs.size() > 32) {
    throw InputError("the store's CRS has no authority code, which .geojson needs; write .csv or .json");
  }
  Document document{{"type", "FeatureCollection"}, {"name", "profile"}};
  const std::string urn = fmt::format("urn:ogc:def:crs:{}::{}", crs.substr(0, colon), crs.substr(colon + 1));
  document["crs"] = {{"type", "name"}, {"properties", {{"name", urn}}}};
  document["features"] = Document::array();
  const std::vector<std::string> names = profile::theme_names(output.metadata);
  for (const SurfaceProfile& surface : output.profiles) {
    for (const std::uint16_t theme : themes_of(surface.profile)) {
      Document feature{{"type", "Feature"}};
      feature["properties"] = {{"tolerance_m", surface.detail.coarsest()},
                               {"length_m", surface.profile.length_m},
                               {"theme", names[theme]},
                               {"gaps", profile::gaps_document(surface.profile)}};
      feature["geometry"] = {{"type", "MultiLineString"}, {"coordinates", lines_of(surface.profile, theme)}};
      document["features"].push_back(std::move(feature));
    }
  }
  return json_text(document) + "\n";
}

std::string text(const ProfileOutput& output) {
  std::vector<ThemeKind> kinds;
  for (const ThemeInfo& theme : output.metadata.themes) kinds.push_back(theme.kind);
  return profile::profile_text(output.profiles.front().profile, output.ground, kinds);
}

std::string chart(const ProfileOutput& output, const std::string& path) {
  profile::Chart chart;
  chart.title = output.title;
  chart.corners_m = output.corners_m;
  chart.note =
      fmt::format("{}; {}; itin {}", std::filesystem::path(output.document["command"]["store"]).filename().string(),
                  crs_title(output.metadata.crs_wkt), ITIN_VERSION);
  for (const SurfaceProfile& surface : output.profiles) chart.series.push_back({surface.name, surface.profile});
  chart.ground = output.ground;
  chart.themes = profile::theme_names(output.metadata);
  return profile::draw_chart(chart, path);
}

std::string bytes_of(const ProfileOutput& output, const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".csv") return csv(output.profiles, output.metadata);
  if (ending == ".json") return json_text(output.document, 2) + "\n";
  if (ending == ".geojson") return geojson(output);
  if (ending == ".txt") return text(output);
  return chart(output, path);
}

}  // namespace

bool is_chart(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".svg" || ending == ".pdf" || ending == ".png";
}

bool is_text(const std::string& path) {
  return ending_of(path) == ".txt";
}

void require_profile_format(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* known : {".csv", ".txt", ".json", ".geojson", ".svg", ".pdf", ".png"}) {
    if (ending == known) return;
  }
  throw InputError(fmt::format("-o '{}': a profile ends in .csv, .txt, .json, .geojson, .svg, .pdf or .png", path));
}

void write_profile(const ProfileOutput& output, const std::string& path) {
  write_file(path, bytes_of(output, path), output.overwrite);
}

}  // namespace itin::cli
