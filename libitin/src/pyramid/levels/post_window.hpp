// The posts of a lattice at one tile of an import, with the squares that the hierarchy of right triangles has there.
//
//   if (const auto window = PostWindow::about(index, tile)) window->is_sound(0, column, row)
//
// Posts are counted from the lower left one of the window, which is the corner of a block. A square is sound where the
// surface on it is that of the posts alone: all posts of it are there and nothing else is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/post_lattice.hpp"
#include "geometry/right_hierarchy.hpp"
#include "pyramid/difference/overlay.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// Halves of a level square. A diagonal makes two of them.
inline constexpr unsigned kLowerLeft = 1, kUpperRight = 2, kUpperLeft = 4, kLowerRight = 8;
/// Halves of a square with level and plumb diagonals.
inline constexpr unsigned kSouth = 1, kNorth = 2, kWest = 4, kEast = 8;
/// The halves that both diagonals make.
inline constexpr unsigned kAllHalves = 15;

/// How far the full surface lies above halves of a square, whose own corners alone are in a level.
struct SquareDifference {
  std::int32_t times = 1;  ///< the differences are multiplied by it, and those at crossings by twice that
  std::int32_t least_at_posts = 0, greatest_at_posts = 0;
  bool crosses = false;  ///< edges of the full surface cross the halves' edges elsewhere than at posts
  std::int32_t least_at_crossings = 0, greatest_at_crossings = 0;

  /// Tells whether the level keeps to a tolerance, in grid units, as verification finds it: differences at crossings
  /// are rounded up.
  bool keeps_to(std::int32_t tolerance) const;
  /// Returns the range of the differences in grid units, rounded outwards as verification does.
  DifferenceRange range() const;
};

class PostWindow {
 public:
  /// Squares have sides of 1 to 64 steps.
  static constexpr std::size_t kSizes = 7;

  /// Returns the posts of all blocks that meet the tile, with a block around them; nothing where no raster's posts are.
  static std::optional<PostWindow> about(const WorkingIndex& index, const CurveRange& tile);

  const PostLattice& lattice() const { return lattice_; }
  /// The column and the row of the lower left block on the lattice.
  const LatticePlace& first_block() const { return first_; }
  /// The number of single squares.
  std::int64_t across() const { return columns_ * kBlockSide; }
  std::int64_t up() const { return rows_ * kBlockSide; }

  std::size_t posts() const { return heights_.size(); }
  std::size_t post(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * (across() + 1) + column);
  }
  std::size_t post(const LatticePlace& p) const { return post(p.column, p.row); }
  /// The level that the index has of a post of sound squares.
  std::uint8_t level(const LatticePlace& p) const { return levels_[post(p)]; }

  /// Tells whether a level square is sound, by its column and row among those with sides of 2^size steps.
  bool is_sound(std::size_t size, std::int64_t column, std::int64_t row) const {
    const std::int64_t across_of_size = across() >> size, up_of_size = up() >> size;
    return column >= 0 && row >= 0 && column < across_of_size && row < up_of_size &&
           sound_[size][static_cast<std::size_t>(row * across_of_size + column)] != 0;
  }
  /// Tells whether the level square with sides of 2 `half` steps about this middle is sound.
  bool is_sound_about(const LatticePlace& middle, std::int64_t half) const;
  bool is_post_of_square(const LatticePlace& p) const {
    return is_sound(0, p.column, p.row) || is_sound(0, p.column - 1, p.row) || is_sound(0, p.column, p.row - 1) ||
           is_sound(0, p.column - 1, p.row - 1);
  }

  /// Returns a position's place; nothing off the lattice and outside the window.
  std::optional<LatticePlace> place_of(Position p) const;
  /// Returns the box of some single squares, cut off where the grid ends.
  GridBox box_of_squares(std::int64_t column, std::int64_t row, std::int64_t across, std::int64_t up) const;

  /// Returns the difference over some halves of the square about a post. These must be sound.
  SquareDifference difference(const LatticePlace& middle, const PostSquare& square, unsigned halves) const;

 private:
  PostWindow() = default;
  bool find_blocks(const WorkingIndex& index, const GridBox& box, std::int64_t points);
  void read(const WorkingIndex& index);
  template <class Met>
  void spoil(const GridBox& box, const Met& met);
  void find_sound_squares();
  void find_sound_squares_of_block(std::int64_t column, std::int64_t row);
  SquareDifference over_level_square(const LatticePlace& middle, std::int32_t half, unsigned halves) const;
  SquareDifference over_upright_square(const LatticePlace& middle, std::int32_t half, unsigned halves) const;
  std::int64_t origin_x() const { return lattice_.x + first_.column * kBlockSide * lattice_.step_x; }
  std::int64_t origin_y() const { return lattice_.y + first_.row * kBlockSide * lattice_.step_x; }

  PostLattice lattice_;
  LatticePlace first_;
  std::int64_t columns_ = 0, rows_ = 0;           ///< the number of blocks each way
  std::vector<std::int32_t> heights_;             ///< by post
  std::vector<std::uint8_t> levels_;              ///< by post
  std::vector<std::vector<std::uint8_t>> sound_;  ///< whether a level square is sound, by size, row and column
};

}  // namespace itin
