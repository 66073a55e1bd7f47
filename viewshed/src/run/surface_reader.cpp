#include "run/surface_reader.hpp"

#include <itin/triangulate.hpp>

#include "progress/stopwatch.hpp"

namespace itin::viewshed {

RetrievedSurface SurfaceReader::surface(const Window& window, const ThemeChoice& themes, std::uint64_t most_posts,
                                        Progress& progress) {
  Stopwatch watch;
  RetrievedSurface surface = retrieve_surface(store_, window, detail_, themes, most_posts, progress);
  statistics_.add_retrieval(surface.statistics(), surface.triangle_count(), watch.lap());
  return surface;
}

std::optional<RetrievedSurface> SurfaceReader::lattice(const Window& window, const ThemeChoice& themes,
                                                       std::uint64_t most_posts, Progress& progress) {
  Stopwatch watch;
  auto lattice = retrieve_lattice(store_, window, detail_, themes, LatticeReader::Heights::kAll, most_posts, progress);
  if (lattice) statistics_.add_retrieval(lattice->statistics(), lattice->triangle_count(), 0);
  statistics_.retrieval_seconds += watch.lap();
  return lattice;
}

Tin SurfaceReader::triangles(const Window& window, const ThemeChoice& themes, Progress& progress) {
  Stopwatch watch;
  Tin tin = triangulate(store_, window, detail_, progress, themes);
  statistics_.add_retrieval(tin.statistics, tin.triangles.size(), watch.lap());
  return tin;
}

}  // namespace itin::viewshed
