// Heights as people write them, in OpenStreetMap for instance.
//
//   written_height("12 m")      // 12
//   written_height("39'4\"")    // 11.99
#pragma once

#include <optional>
#include <string>

namespace itin {

/// Returns the metres of a length with its unit: m, ft, or feet and inches. Nothing for any other text, also for a
/// number without a unit.
std::optional<double> written_height(const std::string& text);

}  // namespace itin
