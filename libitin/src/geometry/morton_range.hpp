// Walks a box along the Morton curve without visiting positions outside it (Tropf and Herzog 1981, "BIGMIN").
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include <itin/precondition.hpp>

#include "geometry/cell.hpp"

namespace itin {

class MortonRange {
 public:
  /// Takes the part of `box` on the grid. Precondition: that part is not empty.
  explicit MortonRange(const GridBox& box)
      : low_(morton(clamp(box.xmin), clamp(box.ymin))), high_(morton(clamp(box.xmax), clamp(box.ymax))) {
    ITIN_PRECONDITION(exists(box));
  }

  /// Tells whether the box has positions on the grid at all.
  static bool exists(const GridBox& box) {
    constexpr GridBox all{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1};
    return !box.empty() && box.meets(all);
  }

  /// Returns the smallest code >= `from` of a position in the box. At most 60 steps.
  std::optional<std::uint64_t> next(std::uint64_t from) const {
    std::uint64_t low = low_, high = high_;
    std::optional<std::uint64_t> best;
    for (int bit = std::bit_width((from ^ low) | (from ^ high)) - 1; bit >= 0; --bit) {
      const bool f = from >> bit & 1, l = low >> bit & 1, h = high >> bit & 1;
      if (f == l && f == h) continue;
      if (!f && l) return low;
      if (f && !h) return best;
      // low and high differ in this bit: cut the box in two.
      if (!f) {
        best = upper_half_low(low, bit);
        high = lower_half_high(high, bit);
      } else {
        low = upper_half_low(low, bit);
      }
    }
    return from;
  }

 private:
  static constexpr std::int32_t clamp(std::int32_t v) {
    return v < -kGridHalfSide ? -kGridHalfSide : v >= kGridHalfSide ? kGridHalfSide - 1 : v;
  }
  /// Returns the bits below `bit` that belong to the same axis.
  static constexpr std::uint64_t axis_below(int bit) {
    constexpr std::uint64_t even = 0x5555555555555555u;
    return (bit % 2 == 0 ? even : even << 1) & ((std::uint64_t{1} << bit) - 1);
  }
  static constexpr std::uint64_t upper_half_low(std::uint64_t low, int bit) {
    return (low | std::uint64_t{1} << bit) & ~axis_below(bit);
  }
  static constexpr std::uint64_t lower_half_high(std::uint64_t high, int bit) {
    return (high & ~(std::uint64_t{1} << bit)) | axis_below(bit);
  }

  std::uint64_t low_, high_;
};

}  // namespace itin
