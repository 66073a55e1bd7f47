// How far a level lies from the full surface, cell by cell (law 2).
//
//   Certificate certificate = store.certificate(3, box);
//   if (auto bounds = certificate.over(triangle_box)) ...   // T_3 + lo <= T_0 <= T_3 + hi over it, grid units
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// Bounds of a height difference, grid units.
struct HeightBounds {
  std::int32_t lo = 0;
  std::int32_t hi = 0;
};

/// The bounds of a level's cells, in memory: about 32 bytes per cell, and a cell holds hundreds of points. Immutable;
/// safe for concurrent use.
class Certificate {
 public:
  struct Cell {
    std::uint64_t code = 0, end = 0;  ///< Morton codes: the cell's first, and the one after its last
    HeightBounds bounds;
  };

  /// Takes disjoint cells in order along the curve.
  explicit Certificate(std::vector<Cell> cells) : cells_(std::move(cells)) {}

  /// Returns the widest bounds of the cells that meet the box; nothing where there is no cell. O(log n) per cell met.
  std::optional<HeightBounds> over(const GridBox& box) const;

 private:
  std::vector<Cell> cells_;
};

}  // namespace itin
