// How footprints become standing features.
#pragma once

#include <cstdint>
#include <string_view>

namespace itin {

enum class RoofKind : std::uint8_t { flat, gabled, hipped, skeleton };
/// What a building's heights count from: the terrain under its footprint, of which the last takes the mean. Its foot
/// lies on the terrain whatever the rule.
enum class BaseRule : std::uint8_t { minimum, mean, maximum, terrain_following };

/// "flat", "gabled", "hipped", "skeleton". Throws InputError.
RoofKind roof_kind(std::string_view name);
/// "minimum", "mean", "maximum", "terrain-following". Throws InputError.
BaseRule base_rule(std::string_view name);

}  // namespace itin
