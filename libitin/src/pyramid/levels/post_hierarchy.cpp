#include "pyramid/levels/post_hierarchy.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/levels/post_window.hpp"

namespace itin {

namespace {

/// Tiles whose levels are held until they are written, because tiles read each other's heights.
constexpr std::size_t kTilesAtOnce = 32;
/// A level is fine where it has one in so many posts, or more.
constexpr std::uint64_t kPostsPerFinePost = 2;

/// The levels that the hierarchy gives to the posts of a window.
///
/// A level square that is not sound is cut into four, whatever the heights, until its parts are sound or single
/// squares.
class WindowLevels {
 public:
  WindowLevels(const PostWindow& window, std::span<const std::int32_t> tolerances)
      : window_(window), tolerances_(tolerances), levels_(window.posts(), 0) {
    for (std::size_t size = 0; size < PostWindow::kSizes; ++size) keep_corners(size);
    // From the least squares to the greatest: so a post has its level before its corners need it.
    for (std::int64_t half = 1; half < kBlockSide; half *= 2) {
      const std::int64_t side = 2 * half;
      for (std::int64_t r = 0; r <= window.up(); r += side)
        for (std::int64_t c = half; c < window.across(); c += side) choose({c, r}, {SquareKind::kOnRow, half});
      for (std::int64_t r = half; r < window.up(); r += side)
        for (std::int64_t c = 0; c <= window.across(); c += side) choose({c, r}, {SquareKind::kOnColumn, half});
      for (std::int64_t r = half; r < window.up(); r += side)
        for (std::int64_t c = half; c < window.across(); c += side) choose({c, r}, {SquareKind::kLevel, half});
    }
  }

  /// The level of a post of sound squares; nothing for other positions.
  std::optional<std::uint8_t> at(Position p) const {
    const auto place = window_.place_of(p);
    if (!place || !window_.is_post_of_square(*place)) return std::nullopt;
    return levels_[window_.post(*place)];
  }

 private:
  /// Keeps the corners of the greatest sound squares at all levels: those that are blocks or not part of a sound one.
  void keep_corners(std::size_t size) {
    const std::int64_t side = std::int64_t{1} << size;
    for (std::int64_t r = 0; r < window_.up() >> size; ++r) {
      for (std::int64_t c = 0; c < window_.across() >> size; ++c) {
        const bool part_of_sound = size + 1 < PostWindow::kSizes && window_.is_sound(size + 1, c / 2, r / 2);
        if (!window_.is_sound(size, c, r) || part_of_sound) continue;
        for (const std::int64_t row : {r * side, (r + 1) * side})
          for (const std::int64_t column : {c * side, (c + 1) * side}) levels_[window_.post(column, row)] = coarsest();
      }
    }
  }

  /// Gives the post in the middle of a square its level, and the square's corners at least the same.
  void choose(const LatticePlace& middle, const PostSquare& square) {
    const std::array<LatticePlace, 2> halves = halves_of(middle, square);
    const std::array<bool, 2> sound{window_.is_sound_about(halves[0], square.half),
                                    window_.is_sound_about(halves[1], square.half)};
    if (!sound[0] && !sound[1]) return;
    std::uint8_t& level = levels_[window_.post(middle)];
    if (level < coarsest()) {
      // Which diagonal halves the square is for others to say; where one half is not sound, the other counts alone.
      const bool on_row = square.kind == SquareKind::kOnRow;
      const unsigned some = sound[0] ? (on_row ? kSouth : kWest) : on_row ? kNorth : kEast;
      level = std::max(level, level_for(window_.difference(middle, square, sound[0] && sound[1] ? kAllHalves : some)));
    }
    if (level == 0) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!sound[i]) continue;
      for (const LatticePlace& corner : corners_in_half(middle, square, halves[i]))
        levels_[window_.post(corner)] = std::max(levels_[window_.post(corner)], level);
    }
  }

  /// The coarsest level that does not keep to its tolerance with these differences.
  std::uint8_t level_for(const SquareDifference& difference) const {
    std::uint8_t level = coarsest();
    while (level > 0 && difference.keeps_to(tolerances_[level])) --level;
    return level;
  }

  std::uint8_t coarsest() const { return static_cast<std::uint8_t>(tolerances_.size() - 1); }

  const PostWindow& window_;
  std::span<const std::int32_t> tolerances_;
  std::vector<std::uint8_t> levels_;  ///< by post
};

/// Calls visit(place, squares) for each block of a window but the outermost ones that has a sound square: its column
/// and row on the lattice, and which of its single squares are sound.
template <class Visit>
void for_each_inner_block(const PostWindow& window, const Visit& visit) {
  for (std::int64_t row = kBlockSide; row < window.up() - kBlockSide; row += kBlockSide) {
    for (std::int64_t column = kBlockSide; column < window.across() - kBlockSide; column += kBlockSide) {
      SoundSquares squares;
      for (std::int64_t r = 0; r < kBlockSide; ++r)
        for (std::int64_t c = 0; c < kBlockSide; ++c)
          if (window.is_sound(0, column + c, row + r)) squares.set(c, r);
      const LatticePlace& first = window.first_block();
      if (squares.any()) visit(LatticePlace{first.column + column / kBlockSide, first.row + row / kBlockSide}, squares);
    }
  }
}

/// What the hierarchy says of a tile.
struct TileLevels {
  PostLattice lattice;
  std::vector<std::pair<LatticePlace, SoundSquares>> blocks;
  std::vector<std::uint8_t> levels;  ///< by the tile's points; kNoLevel for those that are no posts
};

constexpr std::uint8_t kNoLevel = 0xff;

TileLevels levels_of_tile(const WorkingIndex& index, const CurveRange& tile, std::span<const std::int32_t> tolerances) {
  TileLevels result;
  const auto window = PostWindow::about(index, tile);
  if (!window) return result;
  result.lattice = window->lattice();
  for_each_inner_block(*window, [&](const LatticePlace& place, const SoundSquares& squares) {
    result.blocks.emplace_back(place, squares);
  });
  if (result.blocks.empty()) return result;
  const WindowLevels levels(*window, tolerances);
  for (const RawPoint& p : index.read(tile))
    result.levels.push_back(p.level == kDropped ? kNoLevel : levels.at(position_of(p.code)).value_or(kNoLevel));
  return result;
}

/// Writes a tile's levels. Returns the points that have a level already.
std::vector<LevelRaise> write_levels(WorkingIndex& index, const CurveRange& tile,
                                     const std::vector<std::uint8_t>& levels) {
  std::vector<LevelRaise> given;
  if (levels.empty()) return given;
  std::vector<RawPoint> points = index.read(tile);
  for (std::size_t i = 0; i < points.size(); ++i) {
    RawPoint& p = points[i];
    if (p.level != kDropped && p.level > 0) given.push_back({p.code, p.level});
    if (levels[i] != kNoLevel) p.level = std::max<std::uint16_t>(p.level, levels[i]);
  }
  index.write(tile, points);
  return given;
}

/// Makes points of a tile that have a coarser level than this one points of this level.
void cut_levels(WorkingIndex& index, const CurveRange& tile, int coarsest) {
  std::vector<RawPoint> points = index.read(tile);
  for (RawPoint& p : points)
    if (p.level != kDropped) p.level = std::min(p.level, static_cast<std::uint16_t>(coarsest));
  index.write(tile, points);
}

/// Finds the coarsest level that has half of all posts, which are counted by their coarsest levels.
int coarsest_fine_level(const std::vector<std::uint64_t>& posts) {
  const std::uint64_t all = std::accumulate(posts.begin(), posts.end(), std::uint64_t{0});
  std::uint64_t selected = 0;
  for (std::size_t k = posts.size(); k-- > 1;) {
    selected += posts[k];
    if (all > 0 && selected * kPostsPerFinePost >= all) return static_cast<int>(k);
  }
  return 0;
}

}  // namespace

PostHierarchy::PostHierarchy(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                             std::span<const std::int32_t> tolerances, Progress& progress) {
  std::vector<std::uint64_t> posts(tolerances.size(), 0);
  std::vector<CurveRange> with_posts;
  std::vector<LevelRaise> given;
  std::atomic<std::size_t> done = 0;
  for (std::size_t first = 0; first < tiles.size(); first += kTilesAtOnce) {
    std::vector<TileLevels> found(std::min(kTilesAtOnce, tiles.size() - first));
    std::vector<std::vector<LevelRaise>> given_there(found.size());
    parallel_for(found.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      found[i] = levels_of_tile(index, tiles[first + i], tolerances);
      progress.report("finding fine levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
    });
    parallel_for(found.size(),
                 [&](std::size_t i) { given_there[i] = write_levels(index, tiles[first + i], found[i].levels); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].blocks.empty()) continue;
      with_posts.push_back(tiles[first + i]);
      blocks_[found[i].lattice].insert(found[i].blocks.begin(), found[i].blocks.end());
      given.insert(given.end(), given_there[i].begin(), given_there[i].end());
      for (const std::uint8_t level : found[i].levels)
        if (level != kNoLevel) posts[level] += 1;
    }
  }
  coarsest_ = coarsest_fine_level(posts);
  if (coarsest_ == 0) blocks_.clear();
  parallel_for(with_posts.size(), [&](std::size_t i) { cut_levels(index, with_posts[i], coarsest_); });
  index.promote(std::move(given));
}

bool PostHierarchy::has(Position p) const {
  return std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& of_lattice) {
    const auto place = of_lattice.first.place_of(p);
    if (!place) return false;
    const auto& [c, r] = *place;
    const Blocks& blocks = of_lattice.second;
    return is_sound(blocks, c, r, 1) || is_sound(blocks, c - 1, r, 1) || is_sound(blocks, c, r - 1, 1) ||
           is_sound(blocks, c - 1, r - 1, 1);
  });
}

/// Tells whether the level square with this lower left post and sides of so many steps is sound.
bool PostHierarchy::is_sound(const Blocks& blocks, std::int64_t column, std::int64_t row, std::int64_t side) {
  const std::int64_t block_column = floor_divide(column, std::int64_t{kBlockSide}),
                     block_row = floor_divide(row, std::int64_t{kBlockSide});
  const auto block = blocks.find({block_column, block_row});
  return block != blocks.end() &&
         block->second.has(column - block_column * kBlockSide, row - block_row * kBlockSide, side);
}

std::vector<LevelRaise> PostHierarchy::closing(std::span<const LevelRaise> raises) const {
  std::map<std::uint64_t, int> needed;
  for (const auto& [lattice, blocks] : blocks_) {
    std::vector<LevelRaise> open(raises.begin(), raises.end());
    while (!open.empty()) {
      std::vector<LevelRaise> next;
      for (const auto& [code, level] : open) {
        for (const std::uint64_t corner : corners_needed(lattice, blocks, code)) {
          int& known = needed[corner];
          const int wanted = std::min(level, coarsest_);
          if (known < wanted) known = wanted, next.push_back({corner, wanted});
        }
      }
      open = std::move(next);
    }
  }
  std::vector<LevelRaise> result;
  for (const auto& [code, level] : needed) result.push_back({code, level});
  return result;
}

/// The corners that a post needs of the sound halves of its square.
std::vector<std::uint64_t> PostHierarchy::corners_needed(const PostLattice& lattice, const Blocks& blocks,
                                                         std::uint64_t code) {
  std::vector<std::uint64_t> corners;
  const auto place = lattice.place_of(position_of(code));
  if (!place) return corners;
  const PostSquare square = square_about(*place);
  if (square.half == 0) return corners;
  for (const LatticePlace& half : halves_of(*place, square)) {
    if (!is_sound(blocks, half.column - square.half, half.row - square.half, 2 * square.half)) continue;
    for (const auto& [c, r] : corners_in_half(*place, square, half))
      corners.push_back(morton(static_cast<std::int32_t>(lattice.x + c * lattice.step_x),
                               static_cast<std::int32_t>(lattice.y + r * lattice.step_y)));
  }
  sort_unique(corners);
  return corners;
}

}  // namespace itin
