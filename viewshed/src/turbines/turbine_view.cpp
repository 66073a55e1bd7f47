#include <algorithm>
#include <cmath>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <viewshed/turbine_view.hpp>

namespace itin::viewshed {

double vertical_angle_deg(const Earth& earth, double distance, double eye, double low, double high) {
  const double drop = earth.drop(distance);
  const double a = low - drop - eye, b = high - drop - eye;
  // The difference of two arctangents, without cancellation.
  return in_degrees(std::atan2(distance * (b - a), distance * distance + a * b));
}

Arc rotor_arc(Point2 eye, Point2 turbine, double rotor_diameter) {
  const double dx = turbine.x - eye.x, dy = turbine.y - eye.y;
  const double half = rotor_diameter > 0 ? in_degrees(std::atan2(rotor_diameter / 2, std::hypot(dx, dy))) : 0;
  return {within_turn(in_degrees(std::atan2(dx, dy)) - half), 2 * half};
}

RotorHorizon rotor_horizon(std::vector<Arc>& arcs) {
  std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.from < b.from; });
  // The arc begins behind the widest gap; a second round finds gaps and overlaps across north.
  RotorHorizon result;
  double reached = 0;
  for (const Arc& a : arcs) reached = std::max(reached, a.from + a.width - 360);
  double covered = 0, widest = -1;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Arc& a = arcs[i];
    const double end = a.from + a.width;
    // The first arc's gap is the one from the last end, a whole turn back.
    double gap = a.from - reached;
    if (i == 0) {
      double last = 0;
      for (const Arc& other : arcs) last = std::max(last, other.from + other.width);
      gap = a.from + 360 - last;
    }
    if (gap > widest) widest = gap, result.held.from = a.from;
    covered += std::max(0.0, end - std::max(reached, a.from));
    reached = std::max(reached, end);
  }
  result.held.width = std::max(0.0, 360 - std::max(widest, 0.0));
  result.occupied = std::min(covered, 360.0);
  return result;
}

}  // namespace itin::viewshed
