// Window queries: the triangles of the global constrained Delaunay triangulation that meet a window (law 1).
//
//   const Window window = Window::disc({318000, 176000}, 5000);
//   const Tin tin = triangulate(store, window, Detail::tolerance(2), progress);
//   std::cout << tin.triangles.size() << " triangles\n";
#pragma once

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

class Store;

/// Exactly those ground triangles of the triangulation of the whole store, at this detail and with these themes, that
/// meet the window, whatever the window, the tiling or the number of threads. Lines of the terrain are always part of
/// it.
///
/// Cost: reads the leaves that meet the window and a few around it; O(n log n) in the points read. Memory follows the
/// window: about 300 bytes per point while running, 28 bytes per point for the result.
/// Throws InputError (a theme the store does not have), CorruptStore, FileError, Cancelled. An answer without triangles
/// is not an error.
Tin triangulate(const Store& store, const Window& window, const Detail& detail, Progress& progress,
                const ThemeChoice& themes = ThemeChoice::none());

}  // namespace itin
