#include "sheet/wireline_strip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>

#include "drawing/palette.hpp"
#include "drawing/wireline_scene.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

namespace {

/// The degrees from the view's left edge to the middle of the strip.
double middle_of(const Wireline& view, const WirelineStrip& strip) {
  return within_turn(strip.centre_deg - view.query.from_deg);
}

/// The place on paper, in points to the right of the strip's middle and above its horizon.
Point2 on_paper(const WirelineStrip& strip, double from_middle_deg, double elevation_deg) {
  const double principal = strip.principal_mm * kPointsPerMillimetre, azimuth = in_radians(from_middle_deg);
  const double rise = std::tan(in_radians(elevation_deg));
  if (strip.projection == StripProjection::kCylindrical) return {principal * azimuth, principal * rise};
  return {principal * std::tan(azimuth), principal * rise / std::cos(azimuth)};
}

/// The elevation of the skyline in a direction, degrees from the view's left edge; 0 where there is no ground.
double skyline_deg(const Wireline& view, double across_deg) {
  const auto line = static_cast<std::size_t>(std::lround(across_deg / view.query.step_deg));
  double highest = -90;
  for (const WirelineBand& band : view.bands)
    if (line < band.angle_deg.size() && !std::isnan(band.angle_deg[line]))
      highest = std::max<double>(highest, band.angle_deg[line]);
  return highest > -90 ? highest : 0;
}

double middle_height(const Box& frame) {
  return (frame.ymin + frame.ymax) / 2;
}

void draw_bearings(Drawing& drawing, const WirelineStrip& strip) {
  const Box& f = strip.frame;
  const double first = strip.centre_deg - strip.width_deg / 2, last = strip.centre_deg + strip.width_deg / 2;
  for (double a = std::ceil(first / 5) * 5; a <= last + 1e-9; a += 5) {
    const double x = (f.xmin + f.xmax) / 2 + on_paper(strip, a - strip.centre_deg, 0).x;
    drawing.polyline(std::array{Point2{x, f.ymax}, Point2{x, f.ymax + 4}}, {kInk, 0.6, {}});
    drawing.text({x, f.ymax + 12}, fmt::format("{:g}°", within_turn(a)),
                 {.size = 7, .colour = kInk, .align = Align::kCentre});
  }
}

}  // namespace

double horizon_shift(const Wireline& view, const WirelineStrip& strip) {
  constexpr double kRoom = 22;  // points above a tip, for its number
  // These are parts of the frame's height.
  constexpr double kMostTips = 0.4, kMost = 0.9;
  const double middle = middle_of(view, strip), height = strip.frame.height();
  double tips = 0, lowest_tip = height, skyline = on_paper(strip, 0, skyline_deg(view, middle)).y;
  for (const PlacedTurbine& t : placed_turbines(view.query)) {
    const double across = t.across - middle;
    if (std::abs(across) > strip.width_deg / 2) continue;
    const double tip = on_paper(strip, across, t.top).y;
    tips = std::max(tips, tip), lowest_tip = std::min(lowest_tip, tip);
    skyline = std::max(skyline, on_paper(strip, across, skyline_deg(view, t.across)).y);
  }
  const auto shift = [&](double highest, double most) {
    return std::clamp(highest + kRoom - height / 2, 0.0, most * height);
  };
  // The skyline moves no tip out of the frame.
  return std::max(shift(tips, kMostTips),
                  std::min(shift(skyline, kMost), std::max(0.0, height / 2 + lowest_tip - kRoom)));
}

void draw_strip(Drawing& drawing, const Wireline& view, const WirelineStrip& strip) {
  const double middle = middle_of(view, strip), half = strip.width_deg / 2;
  if (middle - half < -1e-6 || middle + half > view.query.width_deg + 1e-6)
    throw InputError(fmt::format("a wireline's strip of {:g} degrees about {:g} is not within its field of view",
                                 strip.width_deg, strip.centre_deg));
  const Box& f = strip.frame;
  const Point2 origin{(f.xmin + f.xmax) / 2, middle_height(f) + horizon_shift(view, strip)};
  drawing.polyline(std::array{Point2{f.xmin, origin.y}, Point2{f.xmax, origin.y}}, {kGrid, 0.5, {}});
  WirelineScene(view, f,
                [&](double across, double elevation) {
                  const Point2 p = on_paper(strip, across - middle, elevation);
                  return Point2{origin.x + p.x, origin.y - p.y};
                },
                {middle - half, middle + half, 6 + strip.weight, strip.weight})
      .draw(drawing);
  drawing.outline(f, {kInk, 0.7, {}});
  draw_bearings(drawing, strip);
}

}  // namespace itin::profile
