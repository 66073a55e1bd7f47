// How footprints become standing features.
#pragma once

#include <cstdint>
#include <string_view>

namespace itin {

enum class RoofKind : std::uint8_t { flat, gabled, hipped, skeleton };
/// Where a building meets the ground. The first three are one elevation taken from the terrain under the footprint;
/// with the last its foot lies on the terrain everywhere, and its heights are above the mean.
enum class BaseRule : std::uint8_t { minimum, mean, maximum, terrain_following };

/// "flat", "gabled", "hipped", "skeleton". Throws InputError.
RoofKind roof_kind(std::string_view name);
/// "minimum", "mean", "maximum", "terrain-following". Throws InputError.
BaseRule base_rule(std::string_view name);

}  // namespace itin
