// Squares of a lattice, some of which are marked, counted so that whole boxes of them can be asked about at once.
//
//   const MarkedSquares open(across, up, [&](std::int64_t column, std::int64_t row) { return ...; });
//   if (!open.any_in(west, east, south, north)) ...
#pragma once

#include <cstdint>
#include <vector>

namespace itin {

class MarkedSquares {
 public:
  /// Has no squares.
  MarkedSquares() = default;
  /// Marks the squares for which is_marked(column, row) holds.
  template <class IsMarked>
  MarkedSquares(std::int64_t across, std::int64_t up, const IsMarked& is_marked)
      : across_(across), up_(up), counts_(static_cast<std::size_t>((across + 1) * (up + 1)), 0) {
    for (std::int64_t row = 0; row < up; ++row) {
      std::uint32_t in_row = 0;
      for (std::int64_t column = 0; column < across; ++column) {
        in_row += is_marked(column, row) ? 1 : 0;
        counts_[corner(column + 1, row + 1)] = counts_[corner(column + 1, row)] + in_row;
      }
    }
  }

  /// Tells whether any square is marked in columns [west, east) and rows [south, north). Those beyond all squares count
  /// as marked.
  bool any_in(std::int64_t west, std::int64_t east, std::int64_t south, std::int64_t north) const {
    return west < 0 || south < 0 || east > across_ || north > up_ ||
           counts_[corner(east, north)] - counts_[corner(west, north)] - counts_[corner(east, south)] +
                   counts_[corner(west, south)] !=
               0;
  }

 private:
  std::size_t corner(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * (across_ + 1) + column);
  }

  std::int64_t across_ = 0, up_ = 0;
  std::vector<std::uint32_t> counts_;  ///< by corner: how many squares to its lower left are marked
};

}  // namespace itin
