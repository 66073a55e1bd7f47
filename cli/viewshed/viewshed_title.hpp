// What maps of a viewshed are called, by mode, and for which surface they hold.
#pragma once

#include <string>

#include <viewshed/result.hpp>

namespace itin::cli {

inline constexpr const char* kAreaLookedAt = "the area looked at";
inline constexpr const char* kOutOfView = "Beyond the radius or the field of view";

std::string title_of(const viewshed::Result& result);

/// Returns the detail of the surface that a result holds for. A certified one holds for all points.
Detail answered_detail(const viewshed::Result& result);

}  // namespace itin::cli
