#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>
#include <profile/antenna_loss.hpp>

namespace itin::profile {

namespace {

double turned_into_circle(double degrees) {
  const double rest = std::fmod(degrees, 360);
  return rest < 0 ? rest + 360 : rest;
}

/// The loss at an angle, straight between the angles that the cut has.
double loss_at(const AntennaPattern::Cut& cut, double degrees) {
  const double at = turned_into_circle(degrees);
  const auto after =
      std::upper_bound(cut.begin(), cut.end(), at, [](double value, const auto& point) { return value < point.first; });
  const auto& [b, loss_b] = after == cut.end() ? cut.front() : *after;
  const auto& [a, loss_a] = after == cut.begin() ? cut.back() : *std::prev(after);
  const double span = turned_into_circle(b - a);
  return span == 0 ? loss_a : loss_a + (loss_b - loss_a) * turned_into_circle(at - a) / span;
}

double greatest_loss(const AntennaPattern::Cut& cut) {
  return std::max_element(cut.begin(), cut.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->second;
}

/// The direction as an antenna sees it whose axis is tilted down.
AntennaDirection seen_from_axis(const AntennaDirection& direction, double tilt_deg) {
  const double azimuth = in_radians(direction.azimuth_deg), elevation = in_radians(direction.elevation_deg);
  const double tilt = in_radians(tilt_deg);
  const double ahead = std::cos(elevation) * std::cos(azimuth), aside = std::cos(elevation) * std::sin(azimuth);
  const double above = std::sin(elevation);
  const double along_axis = ahead * std::cos(tilt) - above * std::sin(tilt);
  const double above_axis = ahead * std::sin(tilt) + above * std::cos(tilt);
  return {in_degrees(std::atan2(aside, along_axis)), in_degrees(std::asin(std::clamp(above_axis, -1.0, 1.0)))};
}

}  // namespace

double off_axis_db(const AntennaPattern& pattern, const AntennaDirection& direction, double tilt_deg) {
  const AntennaDirection seen = seen_from_axis(direction, tilt_deg);
  const double loss = loss_at(pattern.horizontal, seen.azimuth_deg) - loss_at(pattern.horizontal, 0) +
                      loss_at(pattern.vertical, -seen.elevation_deg);
  return std::min(loss, std::max(greatest_loss(pattern.horizontal), greatest_loss(pattern.vertical)));
}

}  // namespace itin::profile
