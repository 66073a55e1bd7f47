#include <cmath>

#include <fmt/format.h>

#include <itin/simplified.hpp>
#include <itin/svg_path.hpp>

namespace itin {

namespace {

/// Writes whole steps as a number of units.
std::string in_units(double steps, double step) {
  const double per_unit = std::round(1 / step);
  std::string text = fmt::format("{}", steps == 0 ? 0.0 : steps / per_unit);
  if (text.starts_with("0.")) text.erase(0, 1);
  if (text.starts_with("-0.")) text.erase(1, 1);
  return text;
}

std::string pair_in_units(Point2 p, double step) {
  const std::string second = in_units(p.y, step);
  return in_units(p.x, step) + (second[0] == '-' ? "" : " ") + second;
}

}  // namespace

std::string svg_number(double value, double step) {
  return in_units(std::round(value / step), step);
}

std::string svg_path(std::span<const Point2> points, const SvgPrecision& precision) {
  std::string path;
  Point2 last;
  for (const Point2& p : simplified(points, precision.tolerance)) {
    const Point2 here{std::round(p.x / precision.step), std::round(p.y / precision.step)};
    if (path.empty()) {
      path = fmt::format("M{}l", pair_in_units(here, precision.step));
    } else if (here.x != last.x || here.y != last.y) {
      const std::string way = pair_in_units({here.x - last.x, here.y - last.y}, precision.step);
      path += (path.back() == 'l' || way[0] == '-' ? "" : " ") + way;
    }
    last = here;
  }
  return path.ends_with('l') ? path + "0 0" : path;
}

}  // namespace itin
