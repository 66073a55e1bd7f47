// Window queries: the triangles of the global constrained Delaunay triangulation that meet a window (law 1).
//
//   const Window window = Window::disc({318000, 176000}, 5000);
//   const Tin tin = triangulate(store, window, Detail::tolerance(2), progress);
//   std::cout << tin.triangles.size() << " triangles\n";
//   const Detail full = Detail::tolerance(0);
//   const auto metres = heights_at(store, {{318000, 176000}}, full, ThemeChoice::all(), progress)[0];
//   if (metres) std::cout << *metres << " m\n";
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

class RasterGrid;
class Store;

/// Returns exactly those ground triangles of the triangulation of the whole store, at this detail and with these
/// themes, that meet the window, whatever the window, the tiling or the number of threads. The triangulation always
/// includes the lines of the terrain.
///
/// Cost: reads the leaves that meet the window and a few around it; O(n log n) in the points read. Memory follows the
/// window: about 300 bytes per point while running, 28 bytes per point for the result. Throws InputError (a theme the
/// store does not have), CorruptStore, FileError, Cancelled. An answer without triangles is not an error.
Tin triangulate(const Store& store, const Window& window, const Detail& detail, Progress& progress,
                const ThemeChoice& themes = ThemeChoice::none());

/// Estimates how many points triangulate() takes for this query; reads directories, no points. Throws InputError,
/// CorruptStore.
std::uint64_t points_about(const Store& store, const Window& window, const Detail& detail,
                           const ThemeChoice& themes = ThemeChoice::none());

/// Returns the elevation of the surface under each position, metres; nothing where there is no ground. A position
/// within a ten-thousandth of a grid unit of a grid point counts as being on it.
///
/// Cost: nearby positions share what is read and triangulated, so that many in one call are far faster than one by one,
/// with the same heights to the last bit. Throws as triangulate() does.
std::vector<std::optional<double>> heights_at(const Store& store, const std::vector<Point2>& positions,
                                              const Detail& detail, const ThemeChoice& themes, Progress& progress);

/// Returns the heights under the centres of a raster's cells, rounded to float; NaN where there is no ground.
std::vector<float> heights_at(const Store& store, const RasterGrid& cells, const Detail& detail,
                              const ThemeChoice& themes, Progress& progress);

}  // namespace itin
