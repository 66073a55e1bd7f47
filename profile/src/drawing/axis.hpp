// One axis of a chart: it maps data to the drawing, and finds round numbers to mark.
#pragma once

#include <string>
#include <vector>

namespace itin::profile {

struct Axis {
  double low = 0, high = 1;  ///< data
  double from = 0, to = 1;   ///< the places of low and high in the drawing

  double at(double value) const { return from + (value - low) / (high - low) * (to - from); }

  /// Multiples of 1, 2 or 5 times a power of ten within [low, high], at most `most` (at least 2) of them.
  std::vector<double> ticks(int most) const;
  /// The distance between ticks.
  double step(int most) const;
};

/// A tick's value with as many decimals as the step needs: 0.5, 1.0, 1.5.
std::string tick_label(double value, double step);

}  // namespace itin::profile
