#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <profile/documents.hpp>
#include <profile/foliage_text.hpp>

namespace itin::profile {

Document gaps_document(const Profile& profile) {
  Document gaps = Document::array();
  for (const auto& [from, to] : profile.gaps) gaps.push_back({from, to});
  return gaps;
}

Document profile_document(const StoreMetadata& metadata, const ThemeChoice& themes,
                          const std::vector<SurfaceProfile>& profiles) {
  const std::vector<std::string> names = theme_names(metadata);
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["surface"] = surface_document(metadata, profiles.front().detail, themes);
  document["length_m"] = profiles.front().profile.length_m;
  document["gaps"] = gaps_document(profiles.front().profile);
  document["profiles"] = Document::array();
  for (const SurfaceProfile& surface : profiles) {
    const Document about = surface_document(metadata, surface.detail, ThemeChoice::none());
    Document entry{{"tolerance_m", surface.detail.coarsest()}, {"certified_error_m", about["certified_error_m"]}};
    if (about.contains("rings")) entry["rings"] = about["rings"];
    entry["gaps"] = gaps_document(surface.profile);
    if (surface.foliage) entry["foliage"] = foliage_document(*surface.foliage, names);
    entry["breakpoints"] = Document::array();
    for (const ProfilePoint& p : surface.profile.points) {
      entry["breakpoints"].push_back(
          {{"distance_m", p.distance_m}, {"x", p.x}, {"y", p.y}, {"z", p.ground_m}, {"theme", names[p.theme]}});
    }
    document["profiles"].push_back(std::move(entry));
  }
  return document;
}

Document links_document(const LinkSurvey& survey) {
  const LinkCounts counts = counts_of(survey);
  RetrievalStatistics read;
  std::uint64_t triangles = 0;
  for (const LinkResult& r : survey.results) {
    read += r.statistics;
    triangles += r.triangles;
  }
  return {{"crs", crs_identifier(survey.metadata.crs_wkt)},
          {"surface", surface_document(survey.metadata, survey.query.detail, survey.query.themes)},
          {"refraction", earth_document(survey.query.earth)},
          {"links",
           {{"visible", counts.visible},
            {"hidden", counts.hidden},
            {"undecided", counts.undecided},
            {"error", counts.error}}},
          {"statistics", statistics_document(read, triangles)}};
}

std::string json_of(const StoreMetadata& metadata, const ThemeChoice& themes,
                    const std::vector<SurfaceProfile>& profiles) {
  if (profiles.empty()) throw InputError("there is no profile to write");
  return result_text(profile_document(metadata, themes, profiles));
}

std::string json_of(const LinkSurvey& survey) {
  return result_text(links_document(survey));
}

}  // namespace itin::profile
