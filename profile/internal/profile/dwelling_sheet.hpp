// What a wind farm is to one dwelling, on one sheet of paper: facts, what each facade sees, shadow flicker by turbine
// and as a calendar, a map of the turbines about it and a plan of its walls.
//
//   profile::DwellingSheet sheet;
//   sheet.title = "Dwelling 7: the mill";
//   sheet.map.scale = profile::scale_of_dwelling_map(sheet.map);
//   sheet.map.layers = layers_over(profile::ground_in_dwelling_map(sheet.map));
//   write("sheet-7-A3.pdf", profile::draw_dwelling_sheet(sheet, "sheet-7-A3.pdf"));
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <profile/flicker_calendar.hpp>
#include <profile/map_sheet.hpp>
#include <profile/sheet_table.hpp>

namespace itin::profile {

struct DwellingSheet {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name, value
  SheetTable facades, turbines;
  FlickerCalendar calendar;
  /// The map about the dwelling: paper, area, scale, CRS, layers, legend, and of its title block project, figure, date
  /// and sources.
  MapSheet map;
  MapSheet plan;  ///< the dwelling alone: its area and layers; an empty area where it has no walls
};

/// The scale of the sheet's map: that given, or the largest usual one at which it shows the area. Throws InputError for
/// a given scale at which the area does not fit.
double scale_of_dwelling_map(const MapSheet& map);
/// The ground that it shows at its scale: what layers may fill.
Box ground_in_dwelling_map(const MapSheet& map);

/// Returns the bytes of a .pdf or .png, by the name's ending. Equal sheets give equal bytes. Throws InputError.
std::string draw_dwelling_sheet(const DwellingSheet& sheet, const std::string& path);

}  // namespace itin::profile
