// Reads what an eye may see of a lattice, and no more.
//
//   reveal_place(observer.position, reader, surface, progress);         // so that its height is known
//   const RadialSweep::View view = reveal(eye, reader, surface, kAnyTiles, progress).view;
//
// Reading goes from the eye outwards, each time as far as what has been read tells what is hidden. A tile is left alone
// if neither it nor targets on its highest post rise above the horizon before it. To the eye such a tile is bare: every
// line into it ends on the way, by far more than rounding, so that every answer is what it would be with the tile.
#pragma once

#include <cstdint>
#include <limits>

#include <itin/geometry.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/progress.hpp>

#include "request/eye.hpp"
#include "scene/exact_scene.hpp"
#include "scene/sweep/radial_sweep.hpp"

namespace itin::viewshed {

inline constexpr std::uint64_t kAnyTiles = std::numeric_limits<std::uint64_t>::max();
struct Revealed {
  RadialSweep::View view;
  double reach;  ///< ends nearer than this along columns or rows may be looked at; bins
};
/// Reads what the eye may see; `surface` is the reader's. Cost: the tiles, and the view. Ends early where it would have
/// to read more than `most_tiles`.
Revealed reveal(const Eye& eye, LatticeReader& reader, ExactScene& surface, std::uint64_t most_tiles,
                Progress& progress);

/// Tells which heights to read at once of about `posts` posts. It is all where it matters how high ground is that
/// nobody sees, and where leaving some out would save little, since there are many observers or few tiles.
LatticeReader::Heights heights_for(const Request& request, std::uint64_t posts);
/// Tells whether it matters how high ground is that nobody sees.
bool asks_for_all_heights(const Request& request);

/// Tells whether no tile with ground is left to read.
bool all_read(const LatticeReader& reader);

/// Reads what lies about a position in metres.
void reveal_place(Point2 position, LatticeReader& reader, ExactScene& surface, Progress& progress);

}  // namespace itin::viewshed
