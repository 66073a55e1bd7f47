// Titles of maps of a viewshed, by mode.
#pragma once

#include <string>

#include <viewshed/result.hpp>

namespace itin::cli {

inline constexpr const char* kAreaLookedAt = "the area looked at";
inline constexpr const char* kOutOfView = "Beyond the radius or the field of view";

std::string title_of(const viewshed::Result& result);

}  // namespace itin::cli
