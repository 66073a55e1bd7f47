// Synthetic terrain for benchmarks: octaves of waves whose height falls with their length, as in hills.
#pragma once

#include <cmath>

namespace itin {

/// The height at a position, all in metres.
inline double hill_height(double x, double y) {
  double z = 0;
  for (int octave = 0; octave < 7; ++octave) {
    const double length = 4000.0 / (1 << octave), turn = 1.3 * octave;
    const double along = x * std::cos(turn) + y * std::sin(turn), across = y * std::cos(turn) - x * std::sin(turn);
    z += length / 20 * std::sin(along * 6.283 / length) * std::cos(across * 4.4 / length + octave);
  }
  return z;
}

}  // namespace itin
