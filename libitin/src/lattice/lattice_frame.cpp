#include "lattice/lattice_frame.hpp"

#include <itin/precondition.hpp>

namespace itin {

bool lay(const PostLattice& posts, const GridBox& box, LatticeTin& lattice) {
  ITIN_PRECONDITION(!box.empty());
  const std::int64_t spacing = posts.side();
  const auto floor_of = [&](std::int64_t v) { return v - ((v % spacing) + spacing) % spacing; };
  // The lattice has whole cells about the box, and a bare one all around.
  const std::int64_t west = floor_of(std::int64_t{box.xmin} - posts.x) - spacing,
                     east = -floor_of(posts.x - std::int64_t{box.xmax}) + spacing,
                     south = floor_of(std::int64_t{box.ymin} - posts.y) - spacing,
                     north = -floor_of(posts.y - std::int64_t{box.ymax}) + spacing;
  lattice.spacing = static_cast<std::int32_t>(spacing);
  lattice.west = static_cast<std::int32_t>(posts.x + west);
  lattice.north = static_cast<std::int32_t>(posts.y + north);
  lattice.columns = static_cast<std::uint32_t>((east - west) / spacing + 1);
  lattice.rows = static_cast<std::uint32_t>((north - south) / spacing + 1);
  const std::uint64_t tiles = std::uint64_t{lattice.tile_columns()} * lattice.tile_rows();
  if (tiles > LatticeTin::kMostTiles) return false;
  lattice.tiles.resize(tiles);
  return true;
}

std::optional<PlaceBox> places_of(const LatticeTin& lattice, const GridBox& box) {
  const std::int64_t spacing = lattice.spacing;
  const auto first = [&](std::int64_t units) { return (units + spacing - 1) / spacing; };
  const std::int64_t west = std::int64_t{box.xmin} - lattice.west, north = std::int64_t{lattice.north} - box.ymax,
                     east = (std::int64_t{box.xmax} - lattice.west) / spacing,
                     south = (std::int64_t{lattice.north} - box.ymin) / spacing;
  if (west < 0 || north < 0 || east >= lattice.columns || south >= lattice.rows || first(west) > east ||
      first(north) > south)
    return std::nullopt;
  return PlaceBox{static_cast<std::uint32_t>(first(west)), static_cast<std::uint32_t>(first(north)),
                  static_cast<std::uint32_t>(east), static_cast<std::uint32_t>(south)};
}

}  // namespace itin
