// The places of a square lattice's posts.
//
//   LatticeTin lattice;
//   if (lay(posts, box, lattice)) place_of(lattice, point)->column
#pragma once

#include <cstdint>
#include <optional>

#include <itin/geometry.hpp>
#include <itin/lattice_tin.hpp>

#include "geometry/post_lattice.hpp"

namespace itin {

/// Lays squares that have all places of `posts` among their corners over a box, with bare cells all around, and makes
/// the lattice's tiles, without ground. Returns false where there would be too many tiles. Precondition: the box is not
/// empty.
bool lay(const PostLattice& posts, const GridBox& box, LatticeTin& lattice);

/// The column and row of the place at a point, or to its north-west.
struct PointPlace {
  std::uint32_t column = 0, row = 0;
  bool post = false;  ///< the point lies at the place itself
};
/// Returns the place of a point; nothing beyond the lattice.
inline std::optional<PointPlace> place_of(const LatticeTin& lattice, const GridPoint& p) {
  const auto spacing = static_cast<std::uint32_t>(lattice.spacing);
  // A negative difference wraps round to a number that is far too large.
  const auto east = static_cast<std::uint32_t>(p.x - lattice.west),
             south = static_cast<std::uint32_t>(lattice.north - p.y);
  const std::uint32_t column = east / spacing, row = south / spacing;
  if (column >= lattice.columns || row >= lattice.rows) return std::nullopt;
  return PointPlace{column, row, column * spacing == east && row * spacing == south};
}

/// The places from a first to a last column and row, all included.
struct PlaceBox {
  std::uint32_t west = 0, north = 0, east = 0, south = 0;
};
/// Returns the places in a box; nothing where the box reaches beyond the lattice, or lies between places.
std::optional<PlaceBox> places_of(const LatticeTin& lattice, const GridBox& box);

}  // namespace itin
