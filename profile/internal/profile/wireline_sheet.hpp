// Wirelines on paper, in the fields of view and at the principal distances of NatureScot's "Visual Representation of
// Wind Farms", version 2.2. Its figures are from memory, consistent in themselves, and not confirmed from the text:
// - planar: 53.5 by 18.2 degrees, 820 by 260 mm, principal distance 812.5 mm, on a page of 841 by 297 mm;
// - cylindrical: 90 by 14.2 degrees, 820 by 130 mm, principal distance 522 mm, wider views in a series.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <profile/map_sheet.hpp>
#include <profile/sheet_table.hpp>
#include <profile/wireline.hpp>

namespace itin::profile {

inline constexpr double kPlanarField = 53.5;  ///< degrees

struct WirelineSheet {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name, value
  double centre_deg = 0;                                   ///< bearing of the middle, from grid north
};

/// Draws one planar sheet, 53.5 degrees about the middle, as PDF. `view` must hold that field. Throws InputError.
std::string draw_planar_sheet(const Wireline& view, const WirelineSheet& sheet, const std::string& path);

/// A field of 90 degrees.
struct WirelineField {
  const Wireline& view;
  double centre_deg = 0;  ///< bearing of its middle, from grid north
  std::string label;      ///< in its corner; may be empty
};
/// The middles of so many fields next to each other about a bearing.
std::vector<double> cylinder_centres(double centre_deg, int fields);
/// Draws two cylindrical fields on a page, as PDF; the farms of the last one are named. Throws InputError.
std::string draw_cylindrical_sheets(const std::vector<WirelineField>& fields, const WirelineSheet& sheet,
                                    const std::string& path);

/// The contents of a viewpoint's sheet besides a wireline of 90 degrees: facts, what is seen of each farm and of each
/// turbine, as far as there is room, and the location.
struct ViewpointSheet {
  WirelineSheet wireline;
  SheetTable farms, turbines;
  MapSheet map;  ///< gives the location map its layers, scale and middle
};
/// The ground that the sheet's map shows: what layers may fill.
Box ground_in_location_map(const MapSheet& map);
std::string draw_viewpoint_sheet(const Wireline& view, const ViewpointSheet& sheet, const std::string& path);

}  // namespace itin::profile
