#include "workflows/zone/study_document.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/undecided_area.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_study_document.hpp>

#include "turbines/proposal.hpp"
#include "workflows/zone/study_radio.hpp"

namespace itin::viewshed {

namespace {

/// The area from which the proposal is seen, and how much of it sees no other turbine.
Document proposal_areas(const Zone& zone, const Visibility& v) {
  std::array<std::uint64_t, kAdditions.size()> cells{};
  for (const std::uint8_t c : additions(zone, v))
    if (c != kNoAddition) ++cells[c];
  const auto km2 = [&](Addition a) { return zone.km2(cells[static_cast<std::size_t>(a)]); };
  using enum Addition;
  return {{"proposal_seen", km2(kBoth) + km2(kProposalAlone)},
          {"others_seen", km2(kBoth) + km2(kOthersAlone)},
          {"additional", km2(kProposalAlone)}};
}

/// The area of the cells whose count passes a test.
template <class Test>
double km2_where(const Zone& zone, const std::vector<std::uint16_t>& counts, const Test& test) {
  return zone.km2(static_cast<std::uint64_t>(std::count_if(counts.begin(), counts.end(), test)));
}

/// The areas from which turbines are seen; `counts` are a Visibility, or those of a season.
template <class Counts>
Document seen_areas(const Zone& zone, const Counts& counts) {
  const auto seen = [](std::uint16_t n) { return n > 0 && n != kCountOutside; };
  Document areas{{"any_tip_seen", km2_where(zone, counts.tip_count, seen)}, {"any_hub_seen", nullptr}};
  if (known_hubs(zone) > 0) areas["any_hub_seen"] = km2_where(zone, counts.hub_count, seen);
  return areas;
}

Document areas_of(const Zone& zone, const Visibility& v) {
  Document areas = seen_areas(zone, v);
  areas["studied"] = km2_where(zone, v.tip_count, [](std::uint16_t n) { return n != kCountOutside; });
  const UndecidedArea of_tips = undecided_area(zone, v.tip_count, v.tip_undecided);
  if (has_proposal(zone.request)) areas["proposal"] = proposal_areas(zone, v);
  areas.update({{"any_tip_undecided", of_tips.any_m2 / 1e6}, {"more_tips_undecided", of_tips.more_m2 / 1e6}});
  if (known_hubs(zone) == 0) return areas;
  const UndecidedArea of_hubs = undecided_area(zone, v.hub_count, v.hub_undecided);
  areas.update({{"any_hub_undecided", of_hubs.any_m2 / 1e6}, {"more_hubs_undecided", of_hubs.more_m2 / 1e6}});
  return areas;
}

Document turbines_document(const ZoneStudy& study) {
  const TurbineTable& table = study.request.turbines;
  Document document = bad_rows_document(table.path, table.rows, study.zone.request.turbines.size(), table.bad);
  document["sha256"] = table.sha256;
  document["hub_heights_known"] = known_hubs(study.zone);
  return document;
}

Document area_document(const Zone& zone) {
  Document document{{"bare", areas_of(zone, zone.bare)}};
  if (zone.screened) document["screened"] = areas_of(zone, *zone.screened);
  if (zone.seasons) {
    document["summer"] = seen_areas(zone, zone.seasons->summer);
    document["winter"] = seen_areas(zone, zone.seasons->winter);
  }
  return document;
}

Document statistics_of(const Zone& zone) {
  Document document = statistics_document(zone.statistics);
  document.update({{"retrieval_seconds", zone.statistics.retrieval_seconds},
                   {"scene_seconds", zone.statistics.scene_seconds},
                   {"lines_seconds", zone.statistics.lines_seconds}});
  return document;
}

}  // namespace

Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used,
                           const std::vector<BadRow>& bad) {
  Document document{{"file", file}, {"rows", rows}, {"used", used}, {"bad", Document::array()}};
  for (const BadRow& row : bad)
    document["bad"].push_back({{"row", row.number}, {"feature", row.feature}, {"message", row.message}});
  return document;
}

std::string bad_row_warning(const std::string& file, const BadRow& row) {
  return fmt::format("{}: row {} ({}) is not used: {}", file, row.number, row.place, row.message);
}

Document study_surface(const ZoneStudy& study) {
  const ZoneRequest& request = study.zone.request;
  return surface_document(study.metadata, request.detail, request.themes.value_or(ThemeChoice::none()));
}

Document zone_study_document(const ZoneStudy& study, const std::string& decides) {
  const Zone& zone = study.zone;
  Document document;
  document["crs"] = crs_identifier(study.metadata.crs_wkt);
  document["surface"] = study_surface(study);
  document["sources"] = sources_document(study.sources);
  document["refraction"] = earth_document(zone.request.earth);
  document["grid"] = grid_document(zone.grid);
  document["turbines"] = turbines_document(study);
  document["farms"] = farms_of(zone.request.turbines);
  document["study_area"] = {{"km2", study.missing.study_m2() / 1e6},
                            {"without_data_km2", study.missing.missing_m2() / 1e6},
                            {"share_without_data", study.missing.share()}};
  document["area_km2"] = area_document(zone);
  if (zone.leaves_open()) document["undecided"] = {{"reason", "ground without data"}, {"decided_by", decides}};
  document.update(radio_document(study));
  document["statistics"] = statistics_of(zone);
  if (const ViewpointTable& table = study.request.viewpoints; has_viewpoints(study.request))
    document["viewpoints"] = bad_rows_document(table.path, table.rows, table.rows - table.bad.size(), table.bad);
  return document;
}

std::string json_of(const ZoneStudy& study) {
  return result_text(zone_study_document(study, ZoneStudyFileOptions().decides_missing_ground));
}

}  // namespace itin::viewshed
