// The lines of a study on its map sheets and in its layers: what it is about, and how far places are from its turbines.
//
//   const StudyLines lines = study_lines(study);
//   draw(lines.rings, lines.study_area, lines.routes);
#pragma once

#include <string>
#include <vector>

#include <profile/map_sheet.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

struct StudyLines {
  profile::SheetLines routes, radio_links;
  profile::SheetLines rings;  ///< each at one distance to the nearest turbine, or to that of a proposal
  std::string rings_text;     ///< what legends call them: "Distance to the nearest turbine, every 5 km"
  profile::SheetLines study_area;
};
StudyLines study_lines(const ZoneStudy& study);

/// The box about the places within the radius of a turbine.
Box study_area(const std::vector<Turbine>& turbines);

/// Returns the least distance of `p` beyond the radius of a turbine, metres: not above 0 in the study area.
double beyond_study_area(const std::vector<Turbine>& turbines, Point2 p);

}  // namespace itin::viewshed
