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
  std::uint16_t theme = 0;               ///< its number, from 1
  std::optional<std::uint32_t> feature;  ///< its number in feature_table.hpp; nothing where the store does not know
  std::vector<Point3> points;            ///< at least two; the first is also the last of a ring
};

/// Returns the lines theme by theme: first lines whose feature is not known, then the others by their features'
/// numbers.
///
/// Lines on the ground are all edges of the surface that meet the window, joined as far as they go on, also outside of
/// the window. An edge that several features share is part of a line of each.
///
/// Themes that stand have the outlines of the footprints that have a part of the surface, as they were imported,
/// rounded to the grid, at the height of the terrain under them. All sides count that meet the window and have terrain
/// under both ends. A measured roof without a footprint has the outline of its surfaces together. Rasters of heights
/// have no outlines.
///
/// Cost: O(n log n) in the edges, and for themes that stand the cost of features_at(). Throws CorruptStore, Cancelled,
/// and InputError for a roof whose surfaces cross too often to have an outline.
std::vector<FeatureLine> feature_lines(const Store& store, const WindowLines& lines, Progress& progress);

}  // namespace itin
