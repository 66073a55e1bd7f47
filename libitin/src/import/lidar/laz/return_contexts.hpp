// Which statistics count for a point, by its return: points of one pulse are alike in other ways than points of pulses
// that came back once. The tables are those of the LAZ format.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace itin {

/// A return of a laser pulse: its number, and how many returns there were. Files may have any combination.
struct PulseReturn {
  unsigned number = 0, of = 0;
  bool single() const { return of == 1; }
  bool first() const { return number == 1; }
  bool last() const { return number >= of; }
  /// How many returns came after it; where the numbers are in disorder, how far they are apart.
  unsigned depth() const { return number > of ? number - of : of - number; }
};

/// The context of differences in plan in point formats 0 to 5, 0 to 15. Precondition: numbers of 0 to 7.
inline unsigned context_of_eight(const PulseReturn& r) {
  static constexpr std::array<std::array<std::uint8_t, 8>, 8> kContexts{{{15, 14, 13, 12, 11, 10, 9, 8},
                                                                         {14, 0, 1, 3, 6, 10, 10, 9},
                                                                         {13, 1, 2, 4, 7, 11, 11, 10},
                                                                         {12, 3, 4, 5, 8, 12, 12, 11},
                                                                         {11, 6, 7, 8, 9, 13, 13, 12},
                                                                         {10, 10, 11, 12, 13, 14, 14, 13},
                                                                         {9, 10, 11, 12, 13, 14, 15, 14},
                                                                         {8, 9, 10, 11, 12, 13, 14, 15}}};
  return kContexts[r.of][r.number];
}

/// The context of differences in plan in point formats 6 to 10, 0 to 5. Precondition: numbers of 0 to 15.
inline unsigned context_of_sixteen(const PulseReturn& r) {
  static constexpr std::array<std::array<std::uint8_t, 16>, 16> kContexts{
      {{0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
       {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
       {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
       {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
       {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
       {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
       {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
       {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
       {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
       {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
       {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
       {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
       {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
       {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
       {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
       {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5}}};
  return kContexts[r.of][r.number];
}

/// The context of a number whose like depends on how wide another was: an even one for each two widths up to `most`,
/// and the next odd one for pulses that came back once.
inline unsigned context_of_width(unsigned width, unsigned most, const PulseReturn& r) {
  return (std::min(width, most) & ~1U) + (r.single() ? 1 : 0);
}

}  // namespace itin
