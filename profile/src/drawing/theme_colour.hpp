// The colour of a theme's features in drawings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// The colour of a theme by its number (from 1); colours repeat.
inline const Colour& theme_colour(std::uint16_t theme) {
  static constexpr Colour kColours[] = {
      {0.72, 0.38, 0.33, 1}, {0.38, 0.58, 0.34, 1}, {0.52, 0.44, 0.68, 1}, {0.85, 0.65, 0.25, 1}};
  return kColours[(theme - std::size_t{1}) % std::size(kColours)];
}

}  // namespace itin::profile
