// The colour of a triangle in a picture: by what it is part of, shaded by the light that falls on it.
#pragma once

#include <array>
#include <numbers>

#include <itin/tin.hpp>

#include "drawing/canvas.hpp"

namespace itin::viewshed {

inline constexpr double kDegree = std::numbers::pi / 180;  ///< radians

class SurfaceColours {
 public:
  /// The light comes over the left shoulder of one who looks to `azimuth`, degrees. `tin` must outlive it.
  SurfaceColours(const Tin& tin, double azimuth);

  /// Ground has one colour, and so have walls; each theme has its own.
  Colour of(const Triangle& t) const;

 private:
  const Tin& tin_;
  std::array<double, 3> light_;
};

}  // namespace itin::viewshed
