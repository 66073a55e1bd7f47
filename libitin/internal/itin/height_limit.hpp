// The one bound on all heights that are read from files or given in a call.
//
//   require_height(feet * 0.3048, "masts.csv: feature 7");
#pragma once

#include <string_view>

namespace itin {

/// The bound, metres up or down, far beyond any ground or mast. A greater number marks missing data, or is in another
/// unit.
inline constexpr double kFarthestHeight = 1e6;

/// Tells whether a number may be a height; false for NaN, too.
constexpr bool is_height(double metres) {
  return metres >= -kFarthestHeight && metres <= kFarthestHeight;
}

/// Throws InputError, a line that begins with `place` (a file and feature, or an option), unless is_height().
void require_height(double metres, std::string_view place);

/// Tells whether a number customarily stands for a missing height: -9999, -32767 or -32768. In a file that declares its
/// missing heights, such a number may be a height.
constexpr bool is_usual_nodata(double height) {
  return height == -9999 || height == -32767 || height == -32768;
}

}  // namespace itin
