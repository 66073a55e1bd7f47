#include "drawing/surface_colours.hpp"

#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>

namespace itin::viewshed {

namespace {

/// The light comes from this much to the left of behind, and from this high, degrees.
constexpr double kLeft = 50, kHigh = 42;
constexpr double kAmbient = 0.42;
/// Surfaces steeper than this are walls: the cosine of their slope.
constexpr double kWall = 0.3;

constexpr Rgba kGroundColour{206, 207, 186}, kWallColour{238, 228, 208};
constexpr Rgba kOther{146, 146, 150};

/// The colour of tops.
Rgba colour_of_kind(ThemeKind kind) {
  switch (kind) {
    case ThemeKind::Buildings:
    case ThemeKind::Terraces:
      return {190, 92, 66};
    case ThemeKind::Vegetation:
      return {104, 144, 84};
    case ThemeKind::Surface:
      return {184, 152, 82};
    default:
      return kOther;
  }
}

}  // namespace

SurfaceColours::SurfaceColours(const Tin& tin, double azimuth, const std::vector<ThemeKind>& kinds) : tin_(tin) {
  for (const ThemeKind kind : kinds) of_themes_.push_back(colour_of_kind(kind));
  const double light = in_radians(azimuth - kLeft), height = in_radians(kHigh);
  light_ = {-std::sin(light) * std::cos(height), -std::cos(light) * std::cos(height), std::sin(height)};
}

Rgba SurfaceColours::of(const Triangle& t) const {
  const Point3 a = tin_.point(t[0]), b = tin_.point(t[1]), c = tin_.point(t[2]);
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  const double length = std::hypot(nx, ny, nz);
  const double lit = length > 0 ? std::max(0.0, (nx * light_[0] + ny * light_[1] + nz * light_[2]) / length) : 1;
  const std::uint16_t theme = tin_.theme(t);
  const Rgba& plain = theme == 0                   ? kGroundColour
                      : nz < kWall * length        ? kWallColour
                      : theme <= of_themes_.size() ? of_themes_[theme - std::size_t{1}]
                                                   : kOther;
  const double shade = kAmbient + (1 - kAmbient) * std::min(1.0, lit * 1.25);
  const auto shaded = [&](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(value * shade)); };
  return {shaded(plain.red), shaded(plain.green), shaded(plain.blue)};
}

}  // namespace itin::viewshed
