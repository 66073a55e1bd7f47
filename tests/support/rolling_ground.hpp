// Ground that rises and falls gently everywhere.
#pragma once

#include <cmath>

namespace itin::test {

/// The height at a column and row of posts, metres.
inline double rolling(int c, int r) {
  return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23) + 0.3 * ((c * 7 + r * 13) % 5);
}

}  // namespace itin::test
