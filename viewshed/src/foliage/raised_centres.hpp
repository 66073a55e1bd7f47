// The centres of cells at the height at which lines end there.
//
//   const std::vector<double> grounds = heights_at_centres(store, grid, cells, detail, ThemeChoice::none(), progress);
//   const std::vector<Point3> eyes = raised_centres(grid, cells, grounds, 1.6);
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>

namespace itin::viewshed {

/// Returns the heights of a surface at the centres of cells, given by their numbers in the grid, metres. Precondition:
/// there is ground at all of them. Throws what heights_at() throws.
std::vector<double> heights_at_centres(const Store& store, const RasterGrid& grid, std::span<const std::size_t> cells,
                                       const Detail& detail, const ThemeChoice& themes, Progress& progress);

/// Returns the centres of cells, each `height` above its ground, metres.
std::vector<Point3> raised_centres(const RasterGrid& grid, std::span<const std::size_t> cells,
                                   std::span<const double> grounds, double height);

}  // namespace itin::viewshed
