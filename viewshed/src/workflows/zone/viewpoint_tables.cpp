#include "workflows/zone/viewpoint_tables.hpp"

#include <optional>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <itin/grid_reference.hpp>

#include "workflows/zone/sight_summary.hpp"

namespace itin::viewshed {

namespace {

const char* yes_or_no(bool value) {
  return value ? "yes" : "no";
}

const char* verdict_cell(TurbineSight::Verdict verdict) {
  return verdict == TurbineSight::Verdict::kUndecided ? "undecided"
                                                      : yes_or_no(verdict == TurbineSight::Verdict::kVisible);
}

/// Returns the cells for hub and tip, and for how much is seen; unknown values have no number.
std::string seen_cells(const TurbineSight& s) {
  const std::string verdicts = fmt::format("{},{}", s.hub ? verdict_cell(*s.hub) : "", verdict_cell(s.tip));
  return s.tip == TurbineSight::Verdict::kUndecided
             ? verdicts + ",,"
             : fmt::format("{},{:.2f},{:.4f}", verdicts, s.visible, s.vertical_deg);
}

std::string viewpoint_row(const Viewpoint& v, const Turbine& t, const TurbineSight& s, const TurbineSight* screened) {
  std::string row = fmt::format("{},{},{:.1f},{:.1f},{:.2f},{},{},{},{:.1f},{:.2f},{},{:.4f},{},{}", v.number,
                                csv_cell(v.name), v.position.x, v.position.y, v.ground, t.number, csv_cell(t.name),
                                csv_cell(t.farm), s.distance, s.azimuth, seen_cells(s), s.tip_deg,
                                yes_or_no(s.distance <= t.radius), s.gaps ? "crosses ground without data" : "");
  if (screened != nullptr) row += "," + seen_cells(*screened);
  return row + "\n";
}

constexpr const char* kViewpointHeader =
    "viewpoint,viewpoint_name,x,y,ground_m,turbine,turbine_name,farm,distance_m,azimuth_grid_deg,hub_visible,"
    "tip_visible,visible_height_m,vertical_angle_deg,tip_elevation_deg,within_radius,note";
constexpr const char* kScreenedHeader =
    ",hub_visible_screened,tip_visible_screened,visible_height_screened_m,vertical_angle_screened_deg";

constexpr const char* kSummaryHeader =
    "viewpoint,viewpoint_name,x,y,grid_reference,ground_m,eye_m,turbines,nearest_turbine,nearest_m,"
    "nearest_azimuth_grid_deg";
constexpr const char* kSummarySeen =
    ",hubs_visible{0},tips_visible{0},nearest_visible_turbine{0},nearest_visible{0}_m,horizontal_from{0}_deg,"
    "horizontal_extent{0}_deg,vertical_angle{0}_deg";

std::string summary_header(bool screened) {
  std::string header = kSummaryHeader + fmt::format(kSummarySeen, "");
  if (screened) header += fmt::format(kSummarySeen, "_screened");
  header += std::string(",tips_beyond_radius,note") + (screened ? ",before_the_eye" : "");
  header += ",hubs_undecided,tips_undecided";
  return header + (screened ? ",hubs_undecided_screened,tips_undecided_screened\n" : "\n");
}

std::string number_cell(std::optional<std::size_t> number) {
  return number ? fmt::format("{}", *number) : "";
}

std::string undecided_cells(const SightSummary& seen) {
  return fmt::format(",{},{}", number_cell(seen.hubs_undecided), seen.tips_undecided);
}

std::string summary_cells(const Zone& zone, const std::vector<TurbineSight>& sights, const SightSummary& seen) {
  std::string cells = fmt::format(",{},{}", number_cell(seen.hubs), seen.tips);
  if (!seen.nearest_seen) return cells + ",,,,,0";
  return cells + fmt::format(",{},{:.0f},{:.1f},{:.1f},{:.3f}", zone.request.turbines[*seen.nearest_seen].number,
                             sights[*seen.nearest_seen].distance, seen.arc->from, seen.arc->width, seen.vertical_deg);
}

std::string summary_row(const StudiedViewpoint& studied, const Zone& zone, bool national) {
  const auto& [v, sights, screened, remark] = studied;
  const SightSummary seen = seen_of(zone, sights, all_turbines(zone));
  const TurbineSight& nearest = sights[seen.nearest];
  const auto reference = national ? national_grid_reference(v.position) : std::nullopt;
  std::string row =
      fmt::format("{},{},{:.1f},{:.1f},{},{:.1f},{:.1f},{},{},{:.0f},{:.1f}", v.number, csv_cell(v.name), v.position.x,
                  v.position.y, reference.value_or(""), v.ground, v.ground + v.height, seen.turbines,
                  zone.request.turbines[seen.nearest].number, nearest.distance, nearest.azimuth);
  row += summary_cells(zone, sights, seen);
  std::optional<SightSummary> behind;
  if (!screened.empty()) behind = seen_of(zone, screened, all_turbines(zone));
  if (behind) row += summary_cells(zone, screened, *behind);
  row += fmt::format(",{},{}", seen.tips_beyond, seen.gaps ? "some lines cross ground without data" : "");
  if (behind) row += "," + csv_cell(remark);
  return row + undecided_cells(seen) + (behind ? undecided_cells(*behind) : "") + "\n";
}

}  // namespace

std::string viewpoint_table(const ZoneStudy& study) {
  std::string table = fmt::format("{}{}\n", kViewpointHeader, study.zone.screened ? kScreenedHeader : "");
  for (const StudiedViewpoint& v : study.viewpoints)
    for (std::size_t k = 0; k < v.bare.size(); ++k)
      table += viewpoint_row(v.viewpoint, study.zone.request.turbines[k], v.bare[k],
                             v.screened.empty() ? nullptr : &v.screened[k]);
  return table;
}

std::string viewpoint_summary(const ZoneStudy& study) {
  const bool national = is_national_grid(study.metadata.crs_wkt);
  std::string summary = summary_header(study.zone.screened.has_value());
  for (const StudiedViewpoint& v : study.viewpoints) summary += summary_row(v, study.zone, national);
  return summary;
}

}  // namespace itin::viewshed
