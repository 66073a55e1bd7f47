#include "workflows/dwellings/output/dwelling_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/in_ring.hpp>
#include <itin/sources_in.hpp>
#include <viewshed/result_sheet.hpp>

#include "workflows/dwellings/flicker_clock.hpp"
#include "workflows/dwellings/output/dwelling_classes.hpp"
#include "workflows/dwellings/output/dwelling_tables.hpp"

namespace itin::viewshed {

namespace {

using MapSample = profile::SheetKey::Sample;

/// The dwellings of a class: buildings by their outlines, places in the open by marks.
MapObjects dwellings_of(const DwellingsSurvey& survey, FlickerClass flicker) {
  const FeatureClass& looks = class_of(flicker);
  profile::SheetLines outlines{{}, looks.colour, 0.5, false};
  profile::SheetMarks marks{profile::SheetSymbol::kViewpoint, looks.colour, {}};
  for (const Dwelling& dwelling : survey.dwellings) {
    if (class_of(flicker_sum(survey, dwelling)) != flicker) continue;
    for (const std::vector<Point2>& ring : dwelling.foot) outlines.lines.push_back({ring, ""});
    if (dwelling.foot.empty()) marks.marks.push_back({dwelling.position, dwelling.name});
  }
  MapObjects objects;
  if (!outlines.lines.empty()) {
    objects.keys.push_back({MapSample::kLine, {looks.colour}, looks.text});
    objects.layers.emplace_back(std::move(outlines));
  }
  if (!marks.marks.empty()) {
    objects.keys.push_back({MapSample::kMark, {looks.colour}, looks.text, marks.symbol});
    objects.layers.emplace_back(std::move(marks));
  }
  return objects;
}

std::vector<MapObjects> dwelling_objects(const DwellingsSurvey& survey) {
  std::vector<MapObjects> objects;
  for (const FlickerClass flicker : {FlickerClass::kNone, FlickerClass::kWithin, FlickerClass::kBeyond})
    objects.push_back(dwellings_of(survey, flicker));
  std::erase_if(objects, [](const MapObjects& o) { return o.layers.empty(); });
  objects.push_back(turbine_objects(survey.request.turbines.turbines));
  return objects;
}

/// The box about the dwellings, and the turbines within the radius of one.
Box box_of_dwellings(const DwellingsSurvey& survey) {
  Box box;
  for (const Dwelling& dwelling : survey.dwellings) {
    box.extend(dwelling.position);
    box.extend(survey.request.turbines.turbines[dwelling.nearest].position);
    box.extend(box_of_rings(dwelling.foot));
  }
  const double margin = 0.05 * std::max(box.width(), box.height());
  return {box.xmin - margin, box.ymin - margin, box.xmax + margin, box.ymax + margin};
}

profile::TitleBlock title_of_dwellings(const Store& store, const DwellingsSurvey& survey, const Box& shown) {
  const DwellingsRequest& request = survey.request;
  const FlickerRules& rules = request.flicker;
  const DwellingCounts counts = counts_of(survey);
  profile::TitleBlock title;
  title.title = "Shadow flicker at dwellings, worst case";
  title.statement = statement_of(survey.metadata, request.themes, Detail::tolerance(0));
  title.facts = {{"Dwellings",
                  fmt::format("{} of {} have shadow flicker: {} more than {:g} h in the year, {} more than {:g} min on "
                              "a day",
                              grouped(counts.with_flicker), grouped(counts.all), grouped(counts.over_year),
                              rules.limit_minutes_year / 60, grouped(counts.over_day), rules.limit_minutes_day)},
                 {"Sun", fmt::format("every minute of {}, {:g} degrees high or higher", rules.year.year,
                                     rules.least_elevation_deg)},
                 {"Reach", rules.blade_width ? fmt::format("{:g} m", kReachOfBlade * *rules.blade_width)
                                             : fmt::format("{:g} rotor diameters", rules.reach_diameters)},
                 {"Eyes", fmt::format("{:g} m above the ground, before each facade", request.eye_height)},
                 {"Earth", request.earth.convention()}};
  title.sources = described(sources_in(store, shown, request.themes), survey.metadata);
  return title;
}

}  // namespace

std::string dwelling_map(const Store& store, const DwellingsSurvey& survey, const profile::SheetChoice& sheets,
                         const std::string& name, Progress& progress) {
  const Box shown = box_of_dwellings(survey);
  const ResultSheet sheet = object_sheet(shown, dwelling_objects(survey), title_of_dwellings(store, survey, shown));
  return draw_result_sheet(store, sheet, profile::PaperSize::kA3, sheets.names(), name, progress);
}

}  // namespace itin::viewshed
