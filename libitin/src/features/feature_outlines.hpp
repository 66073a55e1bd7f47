// The outlines of footprints that have a part of a window's surface.
#pragma once

#include <vector>

#include "features/feature_lines.hpp"

namespace itin {

/// Returns what feature_lines() returns for one theme that stands, in the order of its features' numbers. `theme`
/// counts from 1.
std::vector<FeatureLine> feature_outlines(const Store& store, const WindowLines& window_lines, std::uint16_t theme,
                                          Progress& progress);

}  // namespace itin
