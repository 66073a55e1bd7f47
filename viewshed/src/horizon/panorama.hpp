// How high a surface reaches in a direction from an eye, and where.
//
//   const Panorama panorama(std::make_shared<const HeightPyramid>(tin), request.earth, eye, 20000);
//   if (const auto sky = panorama.sky(90)) std::cout << sky->elevation_deg << " degrees due east\n";
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <itin/earth.hpp>
#include <itin/tin.hpp>
#include <viewshed/horizon.hpp>

#include "bounds/height_pyramid.hpp"
#include "line/sight_line.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

/// Safe for concurrent use. What it finds depends on the triangles under the line alone, not on the rest of the Tin.
class Panorama {
 public:
  /// The surface is a Tin; `reach` is how far to look, metres. The eye must outlive it.
  Panorama(std::shared_ptr<const HeightPyramid> surface, const Earth& earth, const Eye& eye, double reach);

  /// Finds how high the surface reaches; `azimuth` is in degrees from grid north. Nothing where there is no ground;
  /// lines pass over missing ground. Throws InputError for an eye beneath a roof.
  std::optional<SkyPoint> sky(double azimuth) const;

 private:
  /// The place where the line touches the surface, as a fraction of its length, and the theme there.
  using Touch = std::pair<double, std::uint16_t>;

  Touch nearest_touch(const SightLine& line, const std::vector<std::uint32_t>& triangles) const;
  bool ends_behind(Point2 place, const SightLine& line) const;

  std::shared_ptr<const HeightPyramid> surface_;
  const Eye& eye_;
  double drop_;     ///< grid units of drop per squared grid unit
  double grazing_;  ///< grid units
  double reach_;    ///< grid units
};

}  // namespace itin::viewshed
