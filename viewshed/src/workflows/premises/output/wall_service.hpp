// How walls and buildings are served, in the words and colours that tables, layers and maps share.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <itin/feature_style.hpp>
#include <itin/raster.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// The classes of walls.
enum class WallService : std::uint8_t { kLow, kHigh, kUndecided, kUnserved };
inline constexpr std::array<FeatureClass, 4> kWallServices{
    {{"served", "Wall served from the first storey", {0, 114, 178}},
     {"served higher", "Wall served from higher up", {86, 180, 233}},
     {"undecided", "Wall undecided: ground without data", {140, 140, 140}},
     {"not served", "Wall not served", {150, 30, 30}}}};
WallService service_of(const WallPlace& wall, double storey);

/// The classes of buildings.
enum class PremisesService : std::uint8_t { kWall, kRoof, kUndecided, kUnserved, kOutOfReach };
inline constexpr std::array<FeatureClass, 5> kPremisesServices{
    {{"wall", "Building served on a wall", {0, 114, 178}},
     {"roof", "Building served on the roof alone", {0, 158, 115}},
     {"undecided", "Building undecided: ground without data", {140, 140, 140}},
     {"not served", "Building not served", {150, 30, 30}},
     {"out of reach", "Building beyond the radius of all masts", {200, 200, 200}}}};
PremisesService service_of(const Premises& premises);

inline const FeatureClass& class_of(WallService service) {
  return kWallServices[static_cast<std::size_t>(service)];
}
inline const FeatureClass& class_of(PremisesService service) {
  return kPremisesServices[static_cast<std::size_t>(service)];
}

/// "served", "zone cut", "hidden", "undecided" or "out of reach".
const char* word_of(Verdict verdict);
/// "wall" or "roof".
const char* word_of(MountedOn on);
/// The theme, or "terrain".
std::string theme_of(std::uint16_t theme, const StoreMetadata& metadata);

}  // namespace itin::viewshed
