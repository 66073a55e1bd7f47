// Fine levels of rasters by the hierarchy of right triangles on their posts (geometry/right_hierarchy.hpp).
//
// A fine level keeps so many posts that insertion one by one takes far longer than it saves vertices. The hierarchy
// gives a post's level from the heights in its square alone: the post is left out where both ways to halve the square
// keep to the tolerance, with all posts in the square left out. So levels follow from the heights near by, whatever
// is imported elsewhere.
//
// Coarse levels choose from the posts of the coarsest fine level (greedy.hpp). Where they need another post, the fine
// levels take the corners that it needs (closing()). Then the levels are closed, and their triangles are known
// (triangulate/region/right_triangles.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include <itin/progress.hpp>

#include "geometry/post_lattice.hpp"
#include "geometry/right_hierarchy.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// Which of a block's single squares are sound (post_window.hpp), by column and row within the block.
class SoundSquares {
 public:
  void set(std::int64_t column, std::int64_t row) {
    rows_[static_cast<std::size_t>(row)] |= std::uint64_t{1} << column;
  }
  bool any() const {
    return std::any_of(rows_.begin(), rows_.end(), [](std::uint64_t row) { return row != 0; });
  }
  /// Tells whether all squares are sound from this one on, so many each way.
  bool has(std::int64_t column, std::int64_t row, std::int64_t side) const {
    const std::uint64_t wanted = (side == kBlockSide ? ~std::uint64_t{0} : (std::uint64_t{1} << side) - 1) << column;
    const auto first = rows_.begin() + row;
    return std::all_of(first, first + side, [&](std::uint64_t squares) { return (squares & wanted) == wanted; });
  }

 private:
  std::array<std::uint64_t, kBlockSide> rows_{};
};

class PostHierarchy {
 public:
  /// A post's level depends on heights within so many steps of it, and on the choice of fine levels, which is of all
  /// posts.
  static constexpr std::int64_t kReach = 2 * kBlockSide;

  /// Holds no posts.
  PostHierarchy() = default;

  /// Finds the squares that have their posts and nothing else, and writes the levels of these posts to the index: none
  /// coarser than the fine levels, which may be none at all. `tolerances` are in grid units, level 0 first.
  PostHierarchy(WorkingIndex& index, const std::vector<CurveRange>& tiles, std::span<const std::int32_t> tolerances,
                Progress& progress);

  /// Returns the coarsest fine level; 0 where there is none. Fine levels have about half of all posts, or more.
  int coarsest_level() const { return coarsest_; }
  /// Tells whether a position is a post of a sound square.
  bool has(Position p) const;
  /// Returns the raises of other posts that the fine levels need with these to be closed.
  std::vector<LevelRaise> closing(std::span<const LevelRaise> raises) const;

 private:
  struct HashOfPlace {
    std::size_t operator()(const LatticePlace& b) const {
      return static_cast<std::size_t>(b.column * std::int64_t{0x9E3779B1} ^ b.row * std::int64_t{0x85EBCA77});
    }
  };
  using Blocks = std::unordered_map<LatticePlace, SoundSquares, HashOfPlace>;  ///< by their columns and rows of blocks

  static bool is_sound(const Blocks& blocks, std::int64_t column, std::int64_t row, std::int64_t side);
  static std::vector<std::uint64_t> corners_needed(const PostLattice& lattice, const Blocks& blocks,
                                                   std::uint64_t code);

  int coarsest_ = 0;
  std::map<PostLattice, Blocks> blocks_;  ///< lattices as from_first_place() gives them
};

}  // namespace itin
