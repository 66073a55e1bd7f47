// Reads surfaces of a store, and counts in the statistics what was read and how long that took.
//
//   SurfaceReader reader(store, detail, statistics);
//   const Tin ground = reader.triangles(window, ThemeChoice::none(), progress);
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>
#include <viewshed/result.hpp>
#include <viewshed/surface.hpp>

namespace itin::viewshed {

class SurfaceReader {
 public:
  /// Reads surfaces of this detail. Store and statistics must outlive it.
  SurfaceReader(const Store& store, const Detail& detail, Statistics& statistics)
      : store_(store), detail_(detail), statistics_(statistics) {}

  /// As retrieve_surface().
  RetrievedSurface surface(const Window& window, const ThemeChoice& themes, std::uint64_t most_posts,
                           Progress& progress);
  /// As retrieve_lattice(), with all heights. Reading what turns out to be no lattice counts as time alone.
  std::optional<RetrievedSurface> lattice(const Window& window, const ThemeChoice& themes, std::uint64_t most_posts,
                                          Progress& progress);
  /// As triangulate().
  Tin triangles(const Window& window, const ThemeChoice& themes, Progress& progress);

 private:
  const Store& store_;
  Detail detail_;
  Statistics& statistics_;
};

}  // namespace itin::viewshed
