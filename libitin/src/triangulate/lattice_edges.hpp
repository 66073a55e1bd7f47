// The edges of the halves of a lattice's cells, and what lies on either side of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <itin/lattice_tin.hpp>

namespace itin {

/// From a post to a neighbour, along the edge of a cell or a diagonal.
struct LatticeStep {
  int dx, dy;            ///< eastwards and northwards
  int left_dx, left_dy;  ///< the cell to the left: from the post's own column and row, which is that to its south-east
  std::uint8_t left_halves;  ///< of that cell, those that have the edge
  int right_dx, right_dy;
  std::uint8_t right_halves;
};

namespace detail_lattice {
inline constexpr std::uint8_t kSW = LatticeTin::kSouthWest, kNE = LatticeTin::kNorthEast, kNW = LatticeTin::kNorthWest,
                              kSE = LatticeTin::kSouthEast;
}

inline constexpr std::array<LatticeStep, 8> kLatticeSteps = [] {
  using namespace detail_lattice;
  return std::array<LatticeStep, 8>{{{1, 0, 0, -1, kSW | kSE, 0, 0, kNW | kNE},
                                     {1, 1, 0, -1, kNW, 0, -1, kSE},
                                     {0, 1, -1, -1, kNE | kSE, 0, -1, kNW | kSW},
                                     {-1, 1, -1, -1, kSW, -1, -1, kNE},
                                     {-1, 0, -1, 0, kNW | kNE, -1, -1, kSW | kSE},
                                     {-1, -1, -1, 0, kSE, -1, 0, kNW},
                                     {0, -1, 0, 0, kNW | kSW, -1, 0, kNE | kSE},
                                     {1, -1, 0, 0, kNE, 0, 0, kSW}}};
}();

/// Calls visit(column, row, direction) for every edge of a cell's halves with nothing beyond, which begins at that post
/// and goes along kLatticeSteps[direction], the half to its left. halves(column, row) are those of a cell, as far as
/// they are there, or negative where it is not known.
template <class Halves, class Visit>
void for_each_open_edge(std::int64_t column, std::int64_t row, const Halves& halves, const Visit& visit) {
  const int there = halves(column, row);
  if (there <= 0) return;
  for (std::size_t direction = 0; direction < kLatticeSteps.size(); ++direction) {
    const LatticeStep& step = kLatticeSteps[direction];
    if ((there & step.left_halves) == 0) continue;
    const std::int64_t from_column = column - step.left_dx, from_row = row - step.left_dy;
    const int beyond = halves(from_column + step.right_dx, from_row + step.right_dy);
    if (beyond >= 0 && (beyond & step.right_halves) == 0) visit(from_column, from_row, direction);
  }
}

/// The same for all cells of a tile.
template <class Halves, class Visit>
void for_each_open_edge_of(const LatticeTin& lattice, std::uint32_t tile, const Halves& halves, const Visit& visit) {
  using Ground = LatticeTin::Ground;
  const std::uint32_t tile_columns = lattice.tile_columns(), column = tile % tile_columns, row = tile / tile_columns;
  const auto whole = [&](std::uint32_t t) { return lattice.tiles[t].ground == Ground::kWhole; };
  // A whole tile does not lie at the lattice's end.
  const bool all_whole = whole(tile) && column > 0 && row > 0 && whole(tile - 1) && whole(tile + 1) &&
                         whole(tile - tile_columns) && whole(tile + tile_columns);
  if (all_whole || lattice.tiles[tile].ground == Ground::kNone) return;
  constexpr std::uint32_t kSide = LatticeTin::kSide;
  for (std::uint32_t r = 0; r < kSide; ++r) {
    // Amid a whole tile there is none.
    const bool amid = whole(tile) && r > 0 && r + 1 < kSide;
    for (std::uint32_t c = 0; c < kSide; c += amid ? kSide - 1 : 1)
      for_each_open_edge(column * kSide + c, row * kSide + r, halves, visit);
  }
}

}  // namespace itin
