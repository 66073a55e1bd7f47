#include "lattice/post_sheet.hpp"

#include <algorithm>

namespace itin {

std::optional<PostSheet> PostSheet::of(PostHeights posts, const LatticeTin& lattice) {
  const std::int64_t spacing = lattice.spacing, east = posts.lattice.x - lattice.west,
                     south = std::int64_t{lattice.north} - posts.lattice.y;
  if (posts.lattice.step_x != spacing || posts.lattice.step_y != spacing || east % spacing != 0 || south % spacing != 0)
    return std::nullopt;
  // The posts' first row is the southernmost one.
  const std::int64_t first_column = east / spacing, last_row = south / spacing,
                     west = std::max<std::int64_t>(first_column, 0),
                     last_column = std::min<std::int64_t>(first_column + posts.columns, lattice.columns) - 1,
                     north = std::max<std::int64_t>(last_row - posts.rows + 1, 0),
                     bottom = std::min<std::int64_t>(last_row, std::int64_t{lattice.rows} - 1);
  if (west > last_column || north > bottom) return std::nullopt;
  PostSheet sheet{std::move(posts),
                  static_cast<std::uint32_t>(west - first_column),
                  static_cast<std::uint32_t>(last_row),
                  {static_cast<std::uint32_t>(west), static_cast<std::uint32_t>(north),
                   static_cast<std::uint32_t>(last_column), static_cast<std::uint32_t>(bottom)}};
  return sheet;
}

}  // namespace itin
