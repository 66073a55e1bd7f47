#include "drawing/axis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace itin::profile {

double Axis::step(int most) const {
  const double least = (high - low) / std::max(most, 2);
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

std::vector<double> Axis::ticks(int most) const {
  std::vector<double> values;
  const double distance = step(most), slack = 1e-9 * distance;
  for (double i = std::ceil((low - slack) / distance); i * distance <= high + slack; ++i) {
    values.push_back(i * distance);
  }
  return values;
}

std::string tick_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  // The label must not be minus nought.
  const std::string label = fmt::format("{:.{}f}", value, decimals);
  return label.find_first_not_of("-0.") == std::string::npos && label[0] == '-' ? label.substr(1) : label;
}

}  // namespace itin::profile
