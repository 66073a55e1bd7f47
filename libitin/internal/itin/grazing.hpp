// When a sight line grazes the surface, for every answer alike (law 4): it then counts as visible.
#pragma once

namespace itin {

/// Ground that rises above the line by no more than this many metres grazes it: far above the rounding of doubles, far
/// below anything measured.
inline constexpr double kGrazing = 1e-6;

}  // namespace itin
