// Bounds in single precision that hold for double ones.
#pragma once

#include <cmath>

#include "line/infinity.hpp"

namespace itin::viewshed {

/// The greatest float that is no more than `v`; infinities stay as they are.
inline float rounded_down(double v) {
  const auto near = static_cast<float>(v);
  return near <= v ? near : std::nextafter(near, -kFloatInfinity);
}
/// The least float that is no less than `v`.
inline float rounded_up(double v) {
  return -rounded_down(-v);
}

}  // namespace itin::viewshed
