// The edges of the halves of a lattice's cells, and the halves on either side of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <itin/lattice_tin.hpp>
#include <itin/precondition.hpp>

namespace itin {

/// A step from a post to a neighbour, along the edge of a cell or a diagonal.
struct LatticeStep {
  int dx, dy;            ///< eastwards and northwards
  int left_dx, left_dy;  ///< the cell to the left, counted from the post's own column and row: those of the cell to its
                         ///< south-east
  std::uint8_t left_halves;  ///< halves of that cell that have the edge, as bits
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

/// Calls visit(column, row, direction) for every edge of a cell's halves that has no half beyond it. The edge begins at
/// that post and goes along kLatticeSteps[direction], with the cell's half to its left. halves(column, row) returns the
/// halves that a cell has, or a negative number where they are not known.
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

namespace detail_lattice {
/// The number of adjacent cells in a row that are compared together.
inline constexpr std::uint32_t kAlike = 8;

/// Tells whether the kAlike cells of a row from this one on are all whole, and their neighbours in the tile have equal
/// halves. Precondition: the row is neither the first nor the last of the tile.
inline bool whole_and_alike(const std::array<std::uint8_t, LatticeTin::kCells>& halves, std::uint32_t first) {
  ITIN_PRECONDITION(first >= LatticeTin::kSide && first + kAlike + LatticeTin::kSide <= LatticeTin::kCells);
  const auto eight = [&](std::uint32_t from) {
    std::uint64_t word;
    std::memcpy(&word, halves.data() + from, kAlike);
    return word;
  };
  const std::uint8_t one = halves[first];
  const std::uint64_t alike = one * 0x0101010101010101U;
  const std::uint32_t end = first + kAlike;
  return LatticeTin::whole(one & (LatticeTin::kFalling | LatticeTin::kRising)) && eight(first) == alike &&
         eight(first - LatticeTin::kSide) == alike && eight(first + LatticeTin::kSide) == alike &&
         (first % LatticeTin::kSide == 0 || halves[first - 1] == one) &&
         (end % LatticeTin::kSide == 0 || halves[end] == one);
}
}  // namespace detail_lattice

/// Calls for_each_open_edge() for all cells of a tile.
template <class Halves, class Visit>
void for_each_open_edge_of(const LatticeTin& lattice, std::uint32_t tile, const Halves& halves, const Visit& visit) {
  using Ground = LatticeTin::Ground;
  const std::uint32_t tile_columns = lattice.tile_columns(), column = tile % tile_columns, row = tile / tile_columns;
  const auto whole = [&](std::uint32_t t) { return lattice.tiles[t].ground == Ground::kWhole; };
  // A whole tile does not lie at the lattice's end.
  const bool all_whole = whole(tile) && column > 0 && row > 0 && whole(tile - 1) && whole(tile + 1) &&
                         whole(tile - tile_columns) && whole(tile + tile_columns);
  if (all_whole || lattice.tiles[tile].ground == Ground::kNone) return;
  constexpr std::uint32_t kSide = LatticeTin::kSide, kAlike = detail_lattice::kAlike;
  for (std::uint32_t r = 0; r < kSide; ++r) {
    const bool amid = r > 0 && r + 1 < kSide;
    for (std::uint32_t first = 0; first < kSide; first += kAlike) {
      // Whole cells that are alike have no open edges between them, but may have some at the tile's ends.
      const bool alike =
          amid && (whole(tile) || detail_lattice::whole_and_alike(*lattice.tiles[tile].halves, r * kSide + first));
      const std::uint32_t last = first + kAlike - 1;
      for (std::uint32_t c = first; c <= last; ++c)
        if (!alike || c == 0 || c + 1 == kSide) for_each_open_edge(column * kSide + c, row * kSide + r, halves, visit);
    }
  }
}

}  // namespace itin
