// How pictures of maps show places without ground: striped, unlike all that is known.
//
//   pixel = void_colour(column, row, 10);
#pragma once

#include <algorithm>
#include <cstdint>

#include <itin/raster.hpp>

namespace itin {

inline constexpr Rgba kVoid{244, 244, 244}, kVoidStripe{170, 170, 170};

/// How many pixels wide along a row stripes are that are `apart` pixels from each other.
constexpr int void_stripe_width(int apart) {
  return std::max(2, apart / 4);
}

/// The colour of a pixel where there is no ground; stripes are `apart` pixels from each other along a row.
inline Rgba void_colour(std::int64_t column, std::int64_t row, int apart) {
  return (column + row) % apart < void_stripe_width(apart) ? kVoidStripe : kVoid;
}

}  // namespace itin
