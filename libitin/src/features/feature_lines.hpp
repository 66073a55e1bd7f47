// The lines of a window's surface by the features that they are part of.
//
//   for (const FeatureLine& line : feature_lines(store, {tin, window, detail, themes}, progress)) draw(line.points);
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>

namespace itin {

struct FeatureLine {
  std::uint16_t theme = 0;               ///< from 1
  std::optional<std::uint32_t> feature;  ///< its number in feature_table.hpp; nothing where the store does not know
  std::vector<Point3> points;            ///< at least two; the first is also the last of a ring
};

/// Theme by theme, those that no feature is known of first, then by the features' numbers. Lines on the ground are
/// all edges of the surface that meet the window, joined as far as they go on, whatever the window; an edge that
/// features share is part of a line of each. Themes that stand have the outlines of the footprints that have a
/// part of the surface, as they were imported, rounded to the grid, at the height of the terrain under them: all sides
/// that meet the window and have terrain under both ends. Measured roofs without footprints have the outlines of their
/// surfaces together, and rasters of heights have none.
///
/// Cost: O(n log n) in the edges, and for themes that stand that of features_at(). Throws CorruptStore, Cancelled, and
/// InputError for a roof whose surfaces cross too often to have an outline.
std::vector<FeatureLine> feature_lines(const Store& store, const WindowLines& lines, Progress& progress);

}  // namespace itin
