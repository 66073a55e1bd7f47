#include <utility>

#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "window/envelope.hpp"

namespace itin::viewshed {

Box extent_of(const Store& store) {
  return store.metadata().grid.box(store.metadata().bounds);
}

std::optional<RetrievedSurface> retrieve_lattice(const Store& store, const Window& window, const Detail& detail,
                                                 const ThemeChoice& themes, LatticeReader::Heights heights,
                                                 std::uint64_t most_posts, Progress& progress) {
  if (level_within(store.metadata(), detail.coarsest()) != 0) return std::nullopt;
  auto lattice = LatticeReader::open(store, window, themes, heights, most_posts, progress);
  return lattice ? std::optional(RetrievedSurface{{}, std::move(lattice), extent_of(store)}) : std::nullopt;
}

RetrievedSurface retrieve_surface(const Store& store, const Window& window, const Detail& detail,
                                  const ThemeChoice& themes, std::uint64_t most_posts, Progress& progress) {
  if (auto lattice =
          retrieve_lattice(store, window, detail, themes, LatticeReader::Heights::kAll, most_posts, progress))
    return std::move(*lattice);
  return {triangulate(store, window, detail, progress, themes), nullptr, extent_of(store)};
}

}  // namespace itin::viewshed
