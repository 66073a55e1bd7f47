// The meaning of the numbers that a source has for heights.
//
//   const HeightAxis axis = height_axis("EPSG:27700+5715");    // depths below Mean Sea Level, in metres
//   axis.factor() * 10                                         // -10 metres
#pragma once

#include <string>

namespace itin {

struct HeightAxis {
  std::string datum;           ///< its name; empty where it is not stated
  std::string unit = "metre";  ///< its name
  double metres = 1;           ///< that one unit has
  bool down = false;           ///< depths: what is greater lies lower

  /// Heights in metres are this many times the source's numbers.
  double factor() const { return down ? -metres : metres; }
  friend bool operator==(const HeightAxis&, const HeightAxis&) = default;
};

/// "heights above Ordnance Datum Newlyn, unit: metre".
std::string described(const HeightAxis& axis);
/// "metre", "foot (0.3048 m)".
std::string unit_text(const HeightAxis& axis);

/// As an import takes heights in this CRS (SourceInfo::source_crs, say): by its vertical part; where it has none, in
/// the unit of its axes, or in metres where these are angles. Throws InputError.
HeightAxis height_axis(const std::string& crs);

}  // namespace itin
