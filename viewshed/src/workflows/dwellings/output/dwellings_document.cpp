#include <itin/coordinates.hpp>
#include <profile/foliage.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/dwellings_document.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_tables.hpp"

namespace itin::viewshed {

namespace {

Document flicker_document(const FlickerRules& rules) {
  Document document{{"year", rules.year.year},
                    {"clock", clock_name(rules.year)},
                    {"least_elevation_deg", rules.least_elevation_deg},
                    {"limit_hours_year", rules.limit_minutes_year / 60},
                    {"limit_minutes_day", rules.limit_minutes_day}};
  if (rules.blade_width)
    document["reach_m"] = kReachOfBlade * *rules.blade_width;
  else
    document["reach_diameters"] = rules.reach_diameters;
  if (!rules.months) return document;
  for (const MonthShare& month : *rules.months)
    document["months"].push_back({{"sunshine", month.sunshine}, {"operation", month.operation}});
  return document;
}

/// How woods are seen through, and from how many of the dwellings a tip is seen so.
Document seasons_document(const ZoneFoliage& foliage, const DwellingCounts& counts) {
  return {{"extinction", foliage.extinction},
          {"least_transmittance", foliage.least_transmittance},
          {"leaf_area_summer_m2_per_m3", profile::kLeavesOn},
          {"leaf_area_winter_m2_per_m3", profile::kLeavesOff},
          {"see_a_tip_summer", counts.see_a_tip_summer},
          {"see_a_tip_winter", counts.see_a_tip_winter}};
}

}  // namespace

Document dwellings_document(const DwellingsSurvey& survey) {
  const DwellingCounts counts = counts_of(survey);
  const bool screened = survey.request.themes.includes_raised(survey.metadata.themes);
  Document document{{"crs", crs_identifier(survey.metadata.crs_wkt)},
                    {"surface", surface_document(survey.metadata, Detail::tolerance(0), survey.request.themes)},
                    {"refraction", earth_document(survey.request.earth)},
                    {"turbines", survey.request.turbines.turbines.size()},
                    {"flicker", flicker_document(survey.request.flicker)},
                    {"dwellings",
                     {{"all", counts.all},
                      {"with_flicker", counts.with_flicker},
                      {"over_year", counts.over_year},
                      {"over_day", counts.over_day},
                      {"see_a_tip", counts.see_a_tip},
                      {"see_a_tip_screened", screened ? Document(counts.see_a_tip_screened) : Document()}}},
                    {"statistics", statistics_document(survey.statistics)}};
  if (survey.request.foliage && screened) document["foliage"] = seasons_document(*survey.request.foliage, counts);
  return document;
}

std::string json_of(const DwellingsSurvey& survey) {
  return json_text(dwellings_document(survey), 2);
}

}  // namespace itin::viewshed
