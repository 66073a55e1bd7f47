// The ground that many lines share: squares of it, as posts of a lattice or as triangulated tiles.
//
//   const auto sheet = tiles.sheet_at(place, statistics);
//   if (sheet->has(cell) && sheet->stands_alone(cell)) ...
//   const auto tile = tiles.tile_at(place, statistics);      // all ground triangles that meet the square
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>
#include <utility>

#include "cross_section/lattice_sheet.hpp"
#include "cross_section/section_tile.hpp"
#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"
#include "store/file/block_cache.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// The cells of a lattice whose lower left posts lie in a square; none where the ground there is no lattice.
struct SharedSheet : LatticeSheet {
  explicit SharedSheet(LatticeSheet sheet) : LatticeSheet(std::move(sheet)) {}

  /// How often a triangle in the square had to be searched for by itself.
  mutable std::atomic<std::uint32_t> searches = 0;
};

/// Makes the ground of squares, which have few enough points to be made soon, and enough that their borders cost
/// little. Each square is made when first asked for; the squares used last are kept. Safe for concurrent use. Refers to
/// the index and the selection.
class SectionTiles {
 public:
  SectionTiles(const PointIndex& index, const Selection& selection, std::uint64_t cache_bytes);

  const PointIndex& index() const { return index_; }
  const Selection& selection() const { return selection_; }

  /// These return the ground of the square that holds the place. Statistics count what the call read.
  std::shared_ptr<const SectionTile> tile_at(Position place, RetrievalStatistics& statistics);
  std::shared_ptr<const SharedSheet> sheet_at(Position place, RetrievalStatistics& statistics);

 private:
  template <class Made, class Make>
  std::shared_ptr<const Made> found_or_made(std::uint64_t key, const Make& make);
  Cell cell_at(Position place);
  bool is_small(const Cell& cell);

  const PointIndex& index_;
  const Selection& selection_;
  BlockCache cache_;
  std::shared_mutex sizes_;
  std::unordered_map<std::uint64_t, bool> small_;  ///< whether a cell has few enough points
  std::array<std::mutex, 64> makers_;
};

}  // namespace itin
