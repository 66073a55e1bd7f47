// The colours that all drawings share.
#pragma once

#include <itin/raster.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

inline constexpr Colour kInk{0.12, 0.12, 0.12}, kFaint{0.37, 0.37, 0.37}, kGrid{0.87, 0.87, 0.87}, kPaper{1, 1, 1};

inline Colour drawn(const Rgba& c) {
  return {c.red / 255.0, c.green / 255.0, c.blue / 255.0, c.alpha / 255.0};
}

}  // namespace itin::profile
