// Fine levels of rasters by the hierarchy of right triangles on their posts (geometry/right_hierarchy.hpp).
//
// A fine level keeps so many posts that insertion one by one takes far longer than it saves vertices. The hierarchy
// gives a post's level from the heights in its square alone: the post is left out where both ways to halve the square
// keep to the tolerance, with all posts in the square left out.
//
// Which levels are fine is chosen in each work cell by its posts, and a block has the fine levels of all work cells
// that meet it. So levels follow from the heights near by, whatever is imported elsewhere.
//
// Coarse levels choose from the posts of a block's coarsest fine level (greedy.hpp). Where they need another post, the
// fine levels take the corners that it needs (closing()). Then the levels are closed, and their triangles are known
// (triangulate/right_triangles.hpp).
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
#include "pyramid/working_index.hpp"

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
  /// Tells whether a post is a corner of a sound square. Columns and rows of posts go from 0 to kBlockSide.
  bool has_corner(std::int64_t column, std::int64_t row) const {
    const std::uint64_t wanted =
        (column < kBlockSide ? std::uint64_t{1} << column : 0) | (column > 0 ? std::uint64_t{1} << (column - 1) : 0);
    return (row < kBlockSide && (rows_[static_cast<std::size_t>(row)] & wanted) != 0) ||
           (row > 0 && (rows_[static_cast<std::size_t>(row - 1)] & wanted) != 0);
  }

 private:
  std::array<std::uint64_t, kBlockSide> rows_{};
};

class PostHierarchy {
 public:
  /// A post's level depends on heights within so many steps of it, and on the fine levels of its blocks. These depend
  /// on heights within so many steps of the work cells that meet the blocks.
  static constexpr std::int64_t kReach = 2 * kBlockSide;

  /// Holds no posts.
  PostHierarchy() = default;

  /// Finds the squares that have their posts and nothing else, and writes the levels of these posts to the index: none
  /// coarser than the fine levels there, which may be none at all. `tolerances` are in grid units, level 0 first.
  PostHierarchy(WorkingIndex& index, const std::vector<CurveRange>& tiles, std::span<const std::int32_t> tolerances,
                Progress& progress);

  /// Tells whether no level is fine anywhere.
  bool empty() const { return blocks_.empty(); }
  /// Returns the coarsest fine level of the blocks that have this position as a post of a sound square; 0 where there
  /// is none.
  int coarsest_level_at(Position p) const;
  /// Returns the coarsest fine level of a block, by its column and row of blocks; 0 where it has none. The lattice is
  /// as from_first_place() gives it.
  int coarsest_level_of_block(const PostLattice& lattice, const LatticePlace& block) const;
  /// Returns the number of posts, by level, where this level or a coarser one is fine.
  const std::vector<std::uint64_t>& posts() const { return posts_; }
  /// Returns the raises of other posts that the fine levels need with these to be closed.
  std::vector<LevelRaise> closing(std::span<const LevelRaise> raises) const;

 private:
  struct Block {
    SoundSquares squares;
    int coarsest_level = 0;  ///< the coarsest fine level
  };
  struct HashOfPlace {
    std::size_t operator()(const LatticePlace& b) const {
      return static_cast<std::size_t>(b.column * std::int64_t{0x9E3779B1} ^ b.row * std::int64_t{0x85EBCA77});
    }
  };
  using Blocks = std::unordered_map<LatticePlace, Block, HashOfPlace>;  ///< by their columns and rows of blocks

  std::vector<CurveRange> write_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                       std::span<const std::int32_t> tolerances, std::vector<LevelRaise>& given,
                                       Progress& progress);
  void cut_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles);
  static int coarsest_level_in(const Blocks& blocks, std::int64_t column, std::int64_t row, std::int64_t side);
  static std::vector<LevelRaise> corners_needed(const PostLattice& lattice, const Blocks& blocks,
                                                const LevelRaise& post);

  std::map<PostLattice, Blocks> blocks_;  ///< those with fine levels, by lattices as from_first_place() gives them
  std::vector<std::uint64_t> posts_;
};

}  // namespace itin
