#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/grid_units.hpp>
#include <itin/same_place.hpp>
#include <itin/section_line.hpp>

namespace itin {

namespace {

double rounded_distance(double metres) {
  return std::nearbyint(metres / kDistanceUnit) * kDistanceUnit;
}

}  // namespace

SectionLine::SectionLine(const Grid& grid, Point2 a, Point2 b) : grid_(grid) {
  const auto rounded = [&](double v, double origin) {
    const double units = (v - origin) / grid.resolution;
    if (!(std::abs(units) <= 0x1p31))
      throw InputError(fmt::format("the coordinate {:.12g} is too far from the store; check it, and its CRS", v));
    return std::llround(snapped_to_units(units) * kSubgrid);
  };
  std::int64_t bx = rounded(b.x, grid.origin.x), by = rounded(b.y, grid.origin.y);
  ax_ = rounded(a.x, grid.origin.x), ay_ = rounded(a.y, grid.origin.y);
  mirrored_ = std::tie(bx, by) < std::tie(ax_, ay_);
  if (mirrored_) std::swap(ax_, bx), std::swap(ay_, by), std::swap(a, b);
  start_point_ = a, end_point_ = b;
  dx_ = bx - ax_, dy_ = by - ay_;
  length_ = rounded_distance(std::hypot(static_cast<double>(dx_), static_cast<double>(dy_)) * grid.resolution /
                             static_cast<double>(kSubgrid));
  is_point_ = dx_ == 0 && dy_ == 0;
  if (is_point_) dx_ = kSubgrid;
}

bool SectionLine::is_one_place() const {
  const double unit = static_cast<double>(kSubgrid);
  return is_point_ || same_place(static_cast<double>(dx_) / unit, static_cast<double>(dy_) / unit);
}

GridBox SectionLine::start_box() const {
  const auto low = [](std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(v >> 20, -kGridHalfSide, kGridHalfSide - 1));
  };
  return {low(ax_), low(ay_), low(ax_ + kSubgrid - 1), low(ay_ + kSubgrid - 1)};
}

GridBox SectionLine::box(double t0, double t1) const {
  const auto at = [](std::int64_t origin, std::int64_t d, double t) {
    return (static_cast<double>(origin) + t * static_cast<double>(d)) / static_cast<double>(kSubgrid);
  };
  const auto cut = [](double v) {
    return static_cast<std::int32_t>(std::clamp(v, -1.0 * kGridHalfSide, kGridHalfSide - 1.0));
  };
  const double end = is_point_ ? 0 : 1;
  const auto [xmin, xmax] = std::minmax({at(ax_, dx_, t0 * end), at(ax_, dx_, t1 * end)});
  const auto [ymin, ymax] = std::minmax({at(ay_, dy_, t0 * end), at(ay_, dy_, t1 * end)});
  return {cut(std::floor(xmin) - 1), cut(std::floor(ymin) - 1), cut(std::ceil(xmax) + 1), cut(std::ceil(ymax) + 1)};
}

SectionCrossing SectionLine::at(double t, Point3 position, SectionCrossing::Place place) const {
  return {t, rounded_distance(t * length_), position, place};
}

SectionCrossing SectionLine::crossing(const GridPoint& p) const {
  using Place = SectionCrossing::Place;
  const std::int64_t px = subgrid(p.x) - ax_, py = subgrid(p.y) - ay_;
  const Int128 along = static_cast<Int128>(dx_) * px + static_cast<Int128>(dy_) * py;
  const Int128 whole = static_cast<Int128>(dx_) * dx_ + static_cast<Int128>(dy_) * dy_;
  const Place place = along < 0                                ? Place::kBefore
                      : along > (is_point_ ? Int128{} : whole) ? Place::kBeyond
                                                               : Place::kWithin;
  return at(static_cast<double>(along) / static_cast<double>(whole), grid_.point(p), place);
}

SectionCrossing SectionLine::crossing(const GridPoint& p, const GridPoint& q) const {
  return crossing(p, side(p), q, side(q));
}

SectionCrossing SectionLine::crossing(const GridPoint& p, Int128 side_p, const GridPoint& q, Int128 side_q) const {
  using Place = SectionCrossing::Place;
  // The edge has the same order for both triangles beside it.
  if (q < p) return crossing(q, side_q, p, side_p);
  if (side_p == 0) return crossing(p);
  if (side_q == 0) return crossing(q);
  const std::int64_t qx = subgrid(q.x) - subgrid(p.x), qy = subgrid(q.y) - subgrid(p.y);
  // This is the side of the edge on which the start is. At the end it differs by as much as the line's sides of q and p
  // do.
  Int128 before = cross(qx, qy, ax_ - subgrid(p.x), ay_ - subgrid(p.y)), all = side_q - side_p;
  const double s = static_cast<double>(side_p) / static_cast<double>(-all);
  if (all < 0) before = -before, all = -all;
  const Place place = before < 0                              ? Place::kBefore
                      : before > (is_point_ ? Int128{} : all) ? Place::kBeyond
                                                              : Place::kWithin;
  const auto mean = [s](std::int32_t from, std::int32_t to) { return from + s * (static_cast<double>(to) - from); };
  const Point3 position{grid_.origin.x + mean(p.x, q.x) * grid_.resolution,
                        grid_.origin.y + mean(p.y, q.y) * grid_.resolution, mean(p.z, q.z) * grid_.resolution};
  return at(static_cast<double>(before) / static_cast<double>(all), position, place);
}

SectionCrossing SectionLine::between(const SectionCrossing& from, const SectionCrossing& to, double t, Point2 p) const {
  const double width = to.t - from.t;
  const double share = width > 0 ? (t - from.t) / width : 0;
  const double z = from.position.z + share * (to.position.z - from.position.z);
  return at(t, {p.x, p.y, z}, SectionCrossing::Place::kWithin);
}

std::optional<SectionPiece> SectionLine::chord(const std::array<GridPoint, 3>& corners) const {
  const std::array<Int128, 3> sides{side(corners[0]), side(corners[1]), side(corners[2])};
  std::array<SectionCrossing, 6> crossings;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sides[i] == 0) crossings[count++] = crossing(corners[i]);
    if ((sides[i] < 0 && sides[j] > 0) || (sides[i] > 0 && sides[j] < 0))
      crossings[count++] = crossing(corners[i], corners[j]);
  }
  if (count == 0) return std::nullopt;
  const auto by_t = [](const SectionCrossing& a, const SectionCrossing& b) { return a.t < b.t; };
  const auto [first, last] = std::minmax_element(crossings.begin(), crossings.begin() + count, by_t);
  return SectionPiece{*first, *last};
}

std::optional<SectionPiece> SectionLine::clip(const SectionCrossing& from, const SectionCrossing& to) const {
  using Place = SectionCrossing::Place;
  if (to.place == Place::kBefore || from.place == Place::kBeyond) return std::nullopt;
  const double end = is_point_ ? 0 : 1;
  SectionPiece piece{from, to};
  if (from.place == Place::kBefore) piece.from = to.t == 0 ? to : between(from, to, 0, start_point_);
  if (to.place == Place::kBeyond) {
    piece.to = from.t == end ? from : is_point_ ? piece.from : between(from, to, 1, end_point_);
  }
  return piece;
}

}  // namespace itin
