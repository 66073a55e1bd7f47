// The one bound on heights, of whatever is read from files or given in a call.
//
//   require_height(feet * 0.3048, "masts.csv: feature 7");
#pragma once

#include <string_view>

namespace itin {

/// Metres, up or down, far beyond any ground or mast: what is more is a mark for missing data, or in another unit.
inline constexpr double kFarthestHeight = 1e6;

/// False for what is not a number, too.
constexpr bool is_height(double metres) {
  return metres >= -kFarthestHeight && metres <= kFarthestHeight;
}

/// Throws InputError, a line that begins with `place` (a file and feature, or an option), unless
/// is_height().
void require_height(double metres, std::string_view place);

/// Whether a number customarily stands for a missing height: -9999, -32767 or -32768. In a file that declares its
/// missing heights it may be one.
constexpr bool is_usual_nodata(double height) {
  return height == -9999 || height == -32767 || height == -32768;
}

}  // namespace itin
