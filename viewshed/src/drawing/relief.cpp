#include <algorithm>

#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/relief.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/hillshade.hpp"

namespace itin::viewshed {

Relief relief(const Store& store, const RasterGrid& pixels, Progress& progress) {
  constexpr double kTellable = 0.1;  ///< what is smaller cannot be told, in widths of a pixel
  constexpr std::uint64_t kMostPoints = 1'500'000;
  const Box box = pixels.bounds();
  const int fine = level_within(store.metadata(), kTellable * pixels.cell_width());
  const int level = finest_level_of(store, box, kMostPoints, fine);
  const Tin tin = triangulate(store, Window::box(box), detail_of(store.metadata(), level), progress);
  Relief result{pixels, heights_at(tin, pixels), {}};
  result.shades = hillshade(result.heights_m, pixels);
  return result;
}

}  // namespace itin::viewshed
