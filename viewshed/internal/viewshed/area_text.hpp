// Areas in messages, legends and reports, for people to read.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <itin/counted.hpp>

namespace itin::viewshed {

/// Returns "57,960 m²".
inline std::string square_metres_text(double square_metres) {
  return grouped(static_cast<std::uint64_t>(std::llround(square_metres))) + " m²";
}

/// Returns an area as text, such as "366.8 km²" or "57,960 m²".
inline std::string area_text(double square_metres) {
  return square_metres >= 1e5 ? significant(square_metres / 1e6, 4) + " km²" : square_metres_text(square_metres);
}

/// Returns a part of an area as text, in the unit and with the decimals that all parts of the whole have: a legend has
/// one unit.
inline std::string part_text(double square_metres, double whole_square_metres) {
  return whole_square_metres >= 1e6 ? fmt::format("{:.2f} km²", square_metres / 1e6)
                                    : square_metres_text(square_metres);
}

}  // namespace itin::viewshed
