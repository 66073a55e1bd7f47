#pragma once

namespace itin {

/// Returns how far, in metres, a line of a level may stray sideways, from the vertical tolerance of that level: as far
/// as the surface may stray up and down.
constexpr double lateral_tolerance(double vertical) {
  return vertical;
}

}  // namespace itin
