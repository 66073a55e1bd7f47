#include <memory>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>

#include "cross_section/section_tiles.hpp"
#include "cross_section/tiled_section.hpp"
#include "triangulate/raised_index.hpp"

namespace itin {

class SectionSurface::Impl {
 public:
  Impl(const Store& store, const Detail& detail, const ThemeChoice& themes, const Options& options)
      : grid_(store.metadata().grid),
        selection_(selection_of(store.metadata(), detail, themes)),
        index_(store, selection_),
        tiles_(index_, selection_, options.cache_bytes) {}

  bool is_lattice_at(Point2 place) {
    if (!grid_.covers(place)) return false;
    const GridPoint at = grid_.quantise({place.x, place.y, 0});
    RetrievalStatistics uncounted;
    return tiles_.sheet_at({at.x, at.y}, uncounted)->has_cells();
  }

  CrossSection between(Point2 from, Point2 to) { return tiled_section(tiles_, SectionLine(grid_, from, to)); }

 private:
  Grid grid_;
  Selection selection_;
  RaisedIndex index_;
  SectionTiles tiles_;
};

SectionSurface::SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes)
    : SectionSurface(store, detail, themes, Options()) {}
SectionSurface::SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes,
                               const Options& options)
    : impl_(std::make_unique<Impl>(store, detail, themes, options)) {}
SectionSurface::SectionSurface(SectionSurface&&) noexcept = default;
SectionSurface& SectionSurface::operator=(SectionSurface&&) noexcept = default;
SectionSurface::~SectionSurface() = default;

CrossSection SectionSurface::between(Point2 from, Point2 to) const {
  return impl_->between(from, to);
}

bool SectionSurface::is_lattice_at(Point2 place) const {
  return impl_->is_lattice_at(place);
}

}  // namespace itin
