#include "workflows/dwellings/output/dwelling_plan.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/degrees.hpp>

#include "workflows/dwellings/output/dwelling_calendar.hpp"
#include "workflows/dwellings/output/dwelling_names.hpp"

namespace itin::viewshed {

namespace {

using PlanSample = profile::SheetKey::Sample;

constexpr Rgba kDwelling{150, 30, 30, 255}, kOtherTurbine{70, 70, 70, 255}, kSeenOverGround{90, 90, 90, 255},
    kSeenPastAll{20, 60, 140, 255}, kWall{60, 60, 60, 255};

Box widened(const Box& box, double metres) {
  return {box.xmin - metres, box.ymin - metres, box.xmax + metres, box.ymax + metres};
}

std::vector<profile::SheetLine> outline_of(const Dwelling& dwelling) {
  std::vector<profile::SheetLine> lines;
  for (const std::vector<Point2>& ring : dwelling.foot) lines.push_back({ring, ""});
  return lines;
}

MapObjects dwelling_mark(const Dwelling& dwelling) {
  MapObjects objects;
  objects.layers.emplace_back(profile::SheetLines{outline_of(dwelling), kDwelling, 0.4, false});
  objects.layers.emplace_back(
      profile::SheetMarks{profile::SheetSymbol::kDot, kDwelling, {{dwelling.position, name_of_dwelling(dwelling)}}});
  objects.keys.push_back({PlanSample::kMark, {kDwelling}, "The dwelling", profile::SheetSymbol::kDot});
  return objects;
}

/// Turbines whose shadow does not flicker at the dwelling are grey.
MapObjects marked_turbines(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  const std::vector<Turbine>& turbines = survey.request.turbines.turbines;
  const std::vector<ColouredTurbine> coloured = coloured_turbines(dwelling);
  MapObjects objects;
  const auto add = [&](std::size_t turbine, const Rgba& colour) {
    const Turbine& t = turbines[turbine];
    objects.layers.emplace_back(
        profile::SheetMarks{profile::SheetSymbol::kTurbine, colour, {{t.position, fmt::format("{}", t.number)}}});
  };
  for (std::size_t t = 0; t < turbines.size(); ++t)
    if (std::none_of(coloured.begin(), coloured.end(), [&](const ColouredTurbine& c) { return c.turbine == t; }))
      add(t, kOtherTurbine);
  for (const ColouredTurbine& c : coloured) add(c.turbine, c.colour);
  objects.keys.push_back({PlanSample::kMark,
                          {coloured.empty() ? kOtherTurbine : coloured.front().colour},
                          coloured.empty() ? "Wind turbines, numbered"
                                           : "Wind turbines, numbered; those with flicker in the calendar's colours",
                          profile::SheetSymbol::kTurbine});
  return objects;
}

/// The sides of the part of the horizon in which tips are seen.
MapObjects arc_sides(const Dwelling& dwelling, const std::optional<SightSummary>& view, const Box& ground,
                     SightSurface surface) {
  MapObjects objects;
  if (!view || !view->arc) return objects;
  const bool bare = surface == SightSurface::kBare;
  const double length = std::hypot(ground.width(), ground.height());
  profile::SheetLines sides{{}, bare ? kSeenOverGround : kSeenPastAll, bare ? 0.25 : 0.4, bare};
  for (const double bearing : {view->arc->from, view->arc->from + view->arc->width}) {
    const double a = in_radians(bearing);
    const Point2 end{dwelling.position.x + length * std::sin(a), dwelling.position.y + length * std::cos(a)};
    sides.lines.push_back({{dwelling.position, end}, ""});
  }
  objects.keys.push_back({bare ? PlanSample::kDashes : PlanSample::kLine,
                          {sides.colour},
                          fmt::format("Tips seen {}: {:.1f}° of the horizon",
                                      bare ? "over the bare ground" : "past what stands on it", view->arc->width)});
  objects.layers.emplace_back(std::move(sides));
  return objects;
}

}  // namespace

Box area_about(const DwellingsSurvey& survey, const Dwelling& dwelling) {
  const std::vector<Turbine>& turbines = survey.request.turbines.turbines;
  Box area;
  area.extend(dwelling.position);
  area.extend(turbines[dwelling.nearest].position);
  for (const Turbine& turbine : turbines)
    if (distance(dwelling.position, turbine.position) <= survey.request.radius) area.extend(turbine.position);
  for (const std::size_t turbine : flickering_turbines(dwelling)) area.extend(turbines[turbine].position);
  constexpr double kLeastRoom = 50, kRoom = 0.12;
  return widened(area, std::max(kLeastRoom, kRoom * std::max(area.width(), area.height())));
}

std::vector<MapObjects> objects_about(const DwellingsSurvey& survey, const Dwelling& dwelling, const Box& ground) {
  std::vector<MapObjects> objects;
  for (const SightSurface surface : {SightSurface::kBare, SightSurface::kScreened})
    objects.push_back(arc_sides(dwelling, view_of(survey, dwelling, surface), ground, surface));
  objects.push_back(marked_turbines(survey, dwelling));
  objects.push_back(dwelling_mark(dwelling));
  return objects;
}

profile::MapSheet plan_of(const Dwelling& dwelling, profile::PaperSize paper) {
  profile::MapSheet plan;
  plan.paper = paper;
  if (dwelling.foot.empty()) return plan;
  for (const std::vector<Point2>& ring : dwelling.foot)
    for (const Point2& p : ring) plan.area.extend(p);
  plan.area = widened(plan.area, 0.2 * std::max(plan.area.width(), plan.area.height()));
  plan.layers.emplace_back(profile::SheetLines{outline_of(dwelling), kWall, 0.5, false});
  profile::SheetMarks facades{profile::SheetSymbol::kDot, kSeenPastAll, {}};
  for (const DwellingFacade& facade : dwelling.facades)
    facades.marks.push_back({facade.position, fmt::format("{}", facades.marks.size() + 1)});
  plan.layers.emplace_back(std::move(facades));
  return plan;
}

}  // namespace itin::viewshed
