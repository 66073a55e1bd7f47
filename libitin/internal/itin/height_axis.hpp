// The meaning of the numbers that a source has for heights.
//
//   const HeightAxis axis = height_axis("EPSG:27700+5715");    // depths below Mean Sea Level, in metres
//   axis.factor() * 10                                         // -10 metres
#pragma once

#include <string>

namespace itin {

struct HeightAxis {
  std::string datum;           ///< the datum's name; empty where it is not stated
  std::string unit = "metre";  ///< the unit's name
  double metres = 1;           ///< length of one unit
  bool down = false;           ///< depths: greater numbers lie lower

  /// Returns the factor from the source's numbers to heights in metres.
  double factor() const { return down ? -metres : metres; }
  friend bool operator==(const HeightAxis&, const HeightAxis&) = default;
};

/// Returns "heights above Ordnance Datum Newlyn, unit: metre".
std::string described(const HeightAxis& axis);
/// Returns "metre", "foot (0.3048 m)".
std::string unit_text(const HeightAxis& axis);

/// Returns how an import takes heights in this CRS (SourceInfo::source_crs, say): by its vertical part; where it has no
/// such part, in the unit of its axes, or in metres where these are angles. Throws InputError.
HeightAxis height_axis(const std::string& crs);

}  // namespace itin
