// The colour of a triangle in a picture: by what it is part of, shaded by the light that falls on it.
#pragma once

#include <array>
#include <vector>

#include <itin/raster.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

class SurfaceColours {
 public:
  /// The light comes over the left shoulder of one who looks to `azimuth`, degrees. `kinds` has the kind of each theme,
  /// in order. `tin` must outlive this object.
  SurfaceColours(const Tin& tin, double azimuth, const std::vector<ThemeKind>& kinds);

  /// Ground has one colour, and so have walls; each kind of theme has its own.
  Rgba of(const Triangle& t) const;

 private:
  const Tin& tin_;
  std::array<double, 3> light_;
  std::vector<Rgba> of_themes_;  ///< by number, from 1
};

}  // namespace itin::viewshed
