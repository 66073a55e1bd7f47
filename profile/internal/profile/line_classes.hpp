// The classes of lines and of places on them, in the colours of layers and globes.
#pragma once

#include <array>

#include <itin/feature_style.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// In the order of SightVerdict.
inline constexpr std::array<FeatureClass, 3> kVerdictClasses{{{"visible", "In sight", {32, 160, 32}},
                                                              {"hidden", "Hidden", {208, 32, 32}},
                                                              {"undecided", "Undecided", {224, 160, 32}}}};
inline const FeatureClass& class_of(SightVerdict verdict) {
  return kVerdictClasses[static_cast<std::size_t>(verdict)];
}

inline constexpr std::array<FeatureClass, 1> kGroundClass{{{"ground", "Ground", {139, 115, 85}}}};
inline constexpr std::array<FeatureClass, 1> kObstructionClass{
    {{"obstruction", "Rises above the line", {208, 32, 32}}}};
inline constexpr std::array<FeatureClass, 1> kGapClass{{{"gap", "No data", {140, 140, 140}}}};

}  // namespace itin::profile
