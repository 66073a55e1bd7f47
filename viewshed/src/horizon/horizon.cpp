#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/grid_units.hpp>
#include <viewshed/horizon.hpp>

#include "bounds/height_pyramid.hpp"
#include "bounds/surface_heights.hpp"
#include "line/sight_line.hpp"
#include "modes/first_blocker.hpp"
#include "progress/stage.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

std::size_t azimuths_in_a_turn(double step) {
  const double count = std::round(360 / step);
  if (!(step >= 0.001 && step <= 10) || std::abs(count * step - 360) > 1e-6)
    throw InputError(fmt::format(
        "a step of {:g} degrees: give one from 0.001 to 10 that divides 360, for instance 0.1 or 0.25", step));
  return static_cast<std::size_t>(count);
}

/// Grid units: a step that rounding does not swallow, and that no triangle is thin enough to hide in.
constexpr double kStepBehind = 1e-2;

class Panorama {
 public:
  Panorama(const Tin& surface, const Request& request, const Eye& eye)
      : surface_(surface),
        eye_(eye),
        drop_(request.earth.drop_coefficient() * surface.grid.resolution),
        grazing_(kGrazing / surface.grid.resolution),
        reach_(radius_of(request, request.observers.front()).value_or(farthest()) / surface.grid.resolution),
        pyramid_(surface) {}

  std::optional<SkyPoint> sky(double azimuth) const {
    const double x = std::sin(azimuth / kDegreesPerRadian), y = std::cos(azimuth / kDegreesPerRadian);
    const auto line_to = [&](double end) {
      return SightLine(eye_.units, {eye_.units.x + x * reach_, eye_.units.y + y * reach_, end}, drop_, grazing_);
    };
    // Far below all ground in sight.
    const SightLine line = line_to(eye_.units.z);
    LineBundle bundle(line);
    bundle.end = eye_.units.z - 1e4 * reach_;
    std::optional<std::uint32_t> highest;
    pyramid_.search(bundle, [&](std::uint32_t triangle) {
      const Triangle& t = surface_.triangles[triangle];
      const double clear = line.clearing_end(surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]);
      if (clear > bundle.end) bundle.end = clear, highest = triangle;
    });
    if (!highest) return std::nullopt;
    if (std::isinf(bundle.end)) throw InputError("the observer stands beneath a roof or top: it has no horizon");
    return point(line_to(bundle.end), *highest, azimuth, bundle.end);
  }

 private:
  double farthest() const {
    const Box box = surface_.bounds();
    const Point2 p = eye_.position;
    return std::hypot(std::max(p.x - box.xmin, box.xmax - p.x), std::max(p.y - box.ymin, box.ymax - p.y)) + 1;
  }

  SkyPoint point(const SightLine& line, std::uint32_t triangle, double azimuth, double end) const {
    const Triangle& t = surface_.triangles[triangle];
    const double s = line.highest_at(surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]);
    const double unit = surface_.grid.resolution, bulge = drop_ * reach_ * reach_;
    const double rise = end - eye_.units.z, distance = s * reach_ * unit;
    return {std::atan2(rise - bulge, reach_) * kDegreesPerRadian,
            distance,
            {eye_.position.x + distance * std::sin(azimuth / kDegreesPerRadian),
             eye_.position.y + distance * std::cos(azimuth / kDegreesPerRadian),
             (eye_.units.z + s * rise - bulge * s * (1 - s)) * unit},
            surface_.theme(t),
            ends_behind({eye_.units.x + s * line.dx(), eye_.units.y + s * line.dy()}, line)};
  }

  /// Whether no ground lies behind a place in the line's direction, within reach.
  bool ends_behind(Point2 place, const SightLine& line) const {
    const double step = kStepBehind / std::hypot(line.dx(), line.dy());
    const Point2 behind{place.x + step * line.dx(), place.y + step * line.dy()};
    if (std::hypot(behind.x - eye_.units.x, behind.y - eye_.units.y) >= reach_) return false;
    constexpr double kBelowAll = -1e12;
    LineBundle bundle(SightLine({place.x, place.y, kBelowAll}, {behind.x, behind.y, kBelowAll}, drop_, grazing_));
    bool ground = false;
    pyramid_.search(bundle, [&](std::uint32_t triangle) {
      const Triangle& t = surface_.triangles[triangle];
      ground =
          ground || height_over({surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]}, behind);
    });
    return !ground;
  }

  const Tin& surface_;
  const Eye& eye_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
  double reach_;    ///< likewise
  HeightPyramid pyramid_;
};

SightedTarget sighted(const HorizonTarget& target, const Tin& surface, const Tin& base, const Request& request,
                      const Eye& eye, const FirstBlocker& blockers) {
  const auto ground = height_on(base, target.position);
  if (!ground)
    throw InputError(fmt::format("target {} at {:.10g},{:.10g}: there is no data there, or it lies beyond the radius",
                                 target.name, target.position.x, target.position.y));
  SightedTarget result{target};
  result.elevation_m = request.target_absolute ? target.height : *ground + target.height;
  const Point3 to{easting_in_units(surface.grid, target.position.x), northing_in_units(surface.grid, target.position.y),
                  result.elevation_m / surface.grid.resolution};
  const auto [dx, dy] = eye.offset_to(target.position, {to.x, to.y});
  result.distance_m = std::hypot(dx, dy);
  result.azimuth_deg = std::fmod(std::atan2(dx, dy) * kDegreesPerRadian + 360, 360);
  result.elevation_deg = eye.view.elevation(dx, dy, result.elevation_m - eye.elevation);
  result.visible = eye.stands_at({to.x, to.y}) || !blockers.find(eye.units, to);
  return result;
}

}  // namespace

Horizon horizon(const Tin& surface, const Tin& ground, const Request& request, const HorizonOptions& options,
                Progress& progress) {
  validate(request);
  if (request.observers.size() != 1) throw InputError("a horizon is of one observer: give one");
  const std::size_t turn = azimuths_in_a_turn(options.step_deg);
  const Observer& observer = request.observers.front();
  const Eye eye = eye_of(surface.grid, request, observer,
                         height_on(request.observers_on_surface ? surface : ground, observer.position));
  Horizon result;
  result.eye_elevation_m = eye.elevation;
  const auto& azimuths = observer.azimuth ? observer.azimuth : request.azimuth;
  const double start = azimuths ? azimuths->from : 0;
  for (std::size_t i = 0; i < turn; ++i) {
    const double azimuth = std::fmod(start + 360.0 * static_cast<double>(i) / static_cast<double>(turn) + 360, 360);
    if (eye.view.faces(azimuth)) result.points.push_back({azimuth, std::nullopt});
  }
  const Panorama panorama(surface, request, eye);
  for_each_step(result.points.size(), "horizon", progress,
                [&](std::size_t i) { result.points[i].sky = panorama.sky(result.points[i].azimuth_deg); });
  if (options.targets.empty()) return result;
  const FirstBlocker blockers(surface, request.earth);
  for (const HorizonTarget& target : options.targets)
    result.targets.push_back(
        sighted(target, surface, request.targets_on_surface ? surface : ground, request, eye, blockers));
  return result;
}

}  // namespace itin::viewshed
