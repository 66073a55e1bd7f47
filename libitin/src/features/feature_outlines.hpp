// The outlines of footprints that have a part of a window's surface.
#pragma once

#include <vector>

#include "features/feature_lines.hpp"

namespace itin {

/// feature_lines() of one theme that stands, by its number from 1; by the numbers of its features.
std::vector<FeatureLine> feature_outlines(const Store& store, const WindowLines& window_lines, std::uint16_t theme,
                                          Progress& progress);

}  // namespace itin
