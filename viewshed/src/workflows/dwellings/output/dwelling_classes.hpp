// How much shadow flicker dwellings have, in the words and colours that layers and maps share.
#pragma once

#include <array>
#include <cstdint>

#include <itin/feature_style.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

enum class FlickerClass : std::uint8_t { kNone, kWithin, kBeyond };
inline constexpr std::array<FeatureClass, 3> kFlickerClasses{
    {{"none", "Dwelling without shadow flicker", {0, 114, 178}},
     {"within limits", "Dwelling with shadow flicker within the limits", {230, 159, 0}},
     {"beyond limits", "Dwelling with shadow flicker beyond a limit", {150, 30, 30}}}};

inline const FeatureClass& class_of(FlickerClass flicker) {
  return kFlickerClasses[static_cast<std::size_t>(flicker)];
}
inline FlickerClass class_of(const FlickerSum& sum) {
  if (sum.over_year || sum.over_day) return FlickerClass::kBeyond;
  return sum.minutes > 0 ? FlickerClass::kWithin : FlickerClass::kNone;
}

}  // namespace itin::viewshed
