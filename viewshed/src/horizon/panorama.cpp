#include "horizon/panorama.hpp"

#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>
#include <itin/error.hpp>

#include "bounds/surface_heights.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// A step in grid units that rounding does not swallow, and that no triangle is thin enough to hide in.
constexpr double kStepBehind = 1e-2;

}  // namespace

Panorama::Panorama(std::shared_ptr<const HeightPyramid> surface, const Earth& earth, const Eye& eye, double reach)
    : surface_(std::move(surface)),
      eye_(eye),
      drop_(earth.drop_coefficient() * surface_->units().resolution),
      grazing_(kGrazing / surface_->units().resolution),
      reach_(reach / surface_->units().resolution) {}

std::optional<SkyPoint> Panorama::sky(double azimuth) const {
  const double x = std::sin(in_radians(azimuth)), y = std::cos(in_radians(azimuth));
  const auto line_to = [&](double end) {
    return SightLine(eye_.units, {eye_.units.x + x * reach_, eye_.units.y + y * reach_, end}, drop_, grazing_);
  };
  const SightLine level = line_to(eye_.units.z);
  LineBundle bundle(level);
  bundle.end = eye_.units.z - 1e4 * reach_;  // far below all ground in sight
  std::vector<std::uint32_t> highest;        // equally high
  surface_->search(bundle, [&](std::uint32_t triangle) {
    const auto [a, b, c] = surface_->tin().corners(triangle);
    const double clear = level.clearing_end(a, b, c);
    if (clear > bundle.end) bundle.end = clear, highest.clear();
    if (clear == bundle.end) highest.push_back(triangle);
  });
  if (highest.empty()) return std::nullopt;
  if (std::isinf(bundle.end)) throw InputError("the observer stands beneath a roof or top: it has no horizon");
  const SightLine line = line_to(bundle.end);
  const auto [s, theme] = nearest_touch(line, highest);
  const double unit = surface_->units().resolution, bulge = drop_ * reach_ * reach_;
  const double rise = bundle.end - eye_.units.z, distance = s * reach_ * unit;
  return SkyPoint{in_degrees(std::atan2(rise - bulge, reach_)),
                  distance,
                  {eye_.position.x + distance * x, eye_.position.y + distance * y,
                   (eye_.units.z + s * rise - bulge * s * (1 - s)) * unit},
                  theme,
                  ends_behind({eye_.units.x + s * line.dx(), eye_.units.y + s * line.dy()}, line)};
}

/// Takes the nearest: which of several triangles that touch the line is found first depends on what else has been read.
Panorama::Touch Panorama::nearest_touch(const SightLine& line, const std::vector<std::uint32_t>& triangles) const {
  Touch nearest{kInfinity, 0};
  for (const std::uint32_t triangle : triangles) {
    const auto [a, b, c] = surface_->tin().corners(triangle);
    nearest =
        std::min(nearest, Touch{line.highest_at(a, b, c), surface_->tin().theme(surface_->tin().triangles[triangle])});
  }
  return nearest;
}

/// Whether no ground lies behind a place in the line's direction, within reach.
bool Panorama::ends_behind(Point2 place, const SightLine& line) const {
  const double step = kStepBehind / std::hypot(line.dx(), line.dy());
  const Point2 behind{place.x + step * line.dx(), place.y + step * line.dy()};
  if (std::hypot(behind.x - eye_.units.x, behind.y - eye_.units.y) >= reach_) return false;
  constexpr double kBelowAll = -1e12;
  LineBundle bundle(SightLine({place.x, place.y, kBelowAll}, {behind.x, behind.y, kBelowAll}, drop_, grazing_));
  bool ground = false;
  surface_->search(bundle, [&](std::uint32_t triangle) {
    ground = ground || height_over(surface_->tin().corners(triangle), behind).has_value();
  });
  return !ground;
}

}  // namespace itin::viewshed
