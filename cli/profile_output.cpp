#include "profile_output.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <profile/chart.hpp>

#include "store_document.hpp"

namespace itin::cli {

namespace {

using profile::Profile;
using profile::ProfilePoint;

/// This version's stores hold terrain only.
constexpr const char* kTerrain = "terrain";

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

Document gaps_document(const Profile& profile) {
  Document gaps = Document::array();
  for (const auto& [from, to] : profile.gaps) gaps.push_back({from, to});
  return gaps;
}

std::string csv(const std::vector<SurfaceProfile>& profiles) {
  const bool several = profiles.size() > 1;
  std::string text = several ? "tolerance,distance,x,y,z,theme\n" : "distance,x,y,z,theme\n";
  const auto out = std::back_inserter(text);
  for (const SurfaceProfile& surface : profiles) {
    for (const ProfilePoint& p : surface.profile.points) {
      if (several) fmt::format_to(out, "{},", surface.detail.coarsest());
      fmt::format_to(out, "{},{},{},{},{}\n", p.distance_m, p.x, p.y, p.ground_m, kTerrain);
    }
  }
  return text;
}

/// Lines over ground without gap; what is a single point is left out.
Document lines_of(const Profile& profile) {
  Document lines = Document::array();
  Document line = Document::array();
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const ProfilePoint& p = profile.points[i];
    line.push_back({p.x, p.y, p.ground_m});
    if (i + 1 < profile.points.size() && profile.joined(i)) continue;
    if (line.size() > 1) lines.push_back(line);
    line = Document::array();
  }
  return lines;
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
  for (const SurfaceProfile& surface : output.profiles) {
    Document feature{{"type", "Feature"}};
    feature["properties"] = {{"tolerance_m", surface.detail.coarsest()},
                             {"length_m", surface.profile.length_m},
                             {"theme", kTerrain},
                             {"gaps", gaps_document(surface.profile)}};
    feature["geometry"] = {{"type", "MultiLineString"}, {"coordinates", lines_of(surface.profile)}};
    document["features"].push_back(std::move(feature));
  }
  return document.dump() + "\n";
}

std::string chart(const ProfileOutput& output, const std::string& path) {
  profile::Chart chart;
  chart.title = output.title;
  chart.note =
      fmt::format("{}; {}; itin {}", std::filesystem::path(output.document["command"]["store"]).filename().string(),
                  crs_title(output.metadata.crs_wkt), ITIN_VERSION);
  for (const SurfaceProfile& surface : output.profiles) chart.series.push_back({surface.name, surface.profile});
  return profile::draw_chart(chart, path);
}

std::string bytes_of(const ProfileOutput& output, const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".csv") return csv(output.profiles);
  if (ending == ".json") return output.document.dump(2) + "\n";
  if (ending == ".geojson") return geojson(output);
  return chart(output, path);
}

}  // namespace

void require_profile_format(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* known : {".csv", ".json", ".geojson", ".svg", ".pdf", ".png"}) {
    if (ending == known) return;
  }
  throw InputError(fmt::format("-o '{}': a profile ends in .csv, .json, .geojson, .svg, .pdf or .png", path));
}

Document profile_document(const std::vector<SurfaceProfile>& profiles, const StoreMetadata& metadata) {
  Document document;
  document["length_m"] = profiles.front().profile.length_m;
  document["gaps"] = gaps_document(profiles.front().profile);
  document["profiles"] = Document::array();
  for (const SurfaceProfile& surface : profiles) {
    const Document about = surface_document(metadata, surface.detail, ThemeChoice::none());
    Document entry{{"tolerance_m", surface.detail.coarsest()}, {"certified_error_m", about["certified_error_m"]}};
    if (about.contains("rings")) entry["rings"] = about["rings"];
    entry["gaps"] = gaps_document(surface.profile);
    entry["breakpoints"] = Document::array();
    for (const ProfilePoint& p : surface.profile.points) {
      entry["breakpoints"].push_back(
          {{"distance_m", p.distance_m}, {"x", p.x}, {"y", p.y}, {"z", p.ground_m}, {"theme", kTerrain}});
    }
    document["profiles"].push_back(std::move(entry));
  }
  return document;
}

void write_profile(const ProfileOutput& output, const std::string& path) {
  write_file(path, bytes_of(output, path), output.overwrite);
}

}  // namespace itin::cli
