// Areas in messages, legends and reports, for people to read.
#pragma once

#include <string>

#include <fmt/format.h>

namespace itin::viewshed {

/// Returns an area as text, such as "366.8 km²" or "57960 m²".
inline std::string area_text(double square_metres) {
  return square_metres >= 1e5 ? fmt::format("{:.4g} km²", square_metres / 1e6)
                              : fmt::format("{:.0f} m²", square_metres);
}

}  // namespace itin::viewshed
