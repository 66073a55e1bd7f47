// Infinity, which is above all heights and beyond all distances.
#pragma once

#include <limits>

namespace itin::viewshed {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

}  // namespace itin::viewshed
