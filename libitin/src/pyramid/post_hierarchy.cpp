#include "pyramid/post_hierarchy.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include <itin/parallel.hpp>

#include "geometry/whole_division.hpp"
#include "pyramid/post_window.hpp"

namespace itin {

namespace {

/// Tiles whose levels are held until they are written, because tiles read each other's heights.
constexpr std::size_t kTilesAtOnce = 32;
/// A level is fine in a work cell where its heights ask for one in so many posts, or more.
constexpr std::uint64_t kPostsPerFinePost = 2;

/// The levels that the hierarchy gives to the posts of a window.
///
/// A level square that is not sound is cut into four, whatever the heights, until its parts are sound or single
/// squares.
class WindowLevels {
 public:
  WindowLevels(const PostWindow& window, std::span<const std::int32_t> tolerances)
      : window_(window), tolerances_(tolerances), levels_(window.posts(), 0), kept_(window.posts()) {
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
  /// Tells whether a post is kept at all levels, whatever the heights.
  bool is_kept(Position p) const { return kept_[window_.post(*window_.place_of(p))]; }

 private:
  /// Keeps the corners of the greatest sound squares at all levels: those that are blocks or not part of a sound one.
  void keep_corners(std::size_t size) {
    const std::int64_t side = std::int64_t{1} << size;
    for (std::int64_t r = 0; r < window_.up() >> size; ++r) {
      for (std::int64_t c = 0; c < window_.across() >> size; ++c) {
        const bool part_of_sound = size + 1 < PostWindow::kSizes && window_.is_sound(size + 1, c / 2, r / 2);
        if (!window_.is_sound(size, c, r) || part_of_sound) continue;
        for (const std::int64_t row : {r * side, (r + 1) * side})
          for (const std::int64_t column : {c * side, (c + 1) * side}) keep(window_.post(column, row));
      }
    }
  }

  void keep(std::size_t post) {
    levels_[post] = coarsest();
    kept_[post] = true;
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
  std::vector<bool> kept_;            ///< by post
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
  int coarsest_level = 0;            ///< the coarsest fine level
};

constexpr std::uint8_t kNoLevel = 0xff;

/// Returns the column or row of blocks that single squares of this column or row are in.
std::int64_t block_of(std::int64_t place) {
  return floor_divide(place, std::int64_t{kBlockSide});
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
  // Among gaps most posts are kept, which says nothing of the heights.
  std::vector<std::uint64_t> chosen(tolerances.size(), 0);
  for (const RawPoint& p : index.read(tile)) {
    const Position position = position_of(p.code);
    const auto level = p.level == kDropped ? std::nullopt : levels.at(position);
    result.levels.push_back(level.value_or(kNoLevel));
    if (level && !levels.is_kept(position)) chosen[*level] += 1;
  }
  result.coarsest_level = coarsest_fine_level(chosen);
  return result;
}

/// Writes a tile's levels. Returns the points that have a level already.
std::vector<LevelRaise> write_levels_of_tile(WorkingIndex& index, const CurveRange& tile,
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

}  // namespace

PostHierarchy::PostHierarchy(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                             std::span<const std::int32_t> tolerances, Progress& progress)
    : posts_(tolerances.size(), 0) {
  std::vector<LevelRaise> given;
  const std::vector<CurveRange> with_posts = write_levels(index, tiles, tolerances, given, progress);
  for (auto& [lattice, blocks] : blocks_)
    std::erase_if(blocks, [](const auto& block) { return block.second.coarsest_level == 0; });
  std::erase_if(blocks_, [](const auto& of_lattice) { return of_lattice.second.empty(); });
  cut_levels(index, with_posts);
  index.promote(std::move(given));
}

/// Writes the levels of all posts, and finds the fine levels of blocks. Returns the tiles that have posts, and in
/// `given` the points that have a level already.
std::vector<CurveRange> PostHierarchy::write_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                                    std::span<const std::int32_t> tolerances,
                                                    std::vector<LevelRaise>& given, Progress& progress) {
  std::vector<CurveRange> with_posts;
  std::atomic<std::size_t> done = 0;
  for (std::size_t first = 0; first < tiles.size(); first += kTilesAtOnce) {
    std::vector<TileLevels> found(std::min(kTilesAtOnce, tiles.size() - first));
    std::vector<std::vector<LevelRaise>> given_there(found.size());
    parallel_for(found.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      found[i] = levels_of_tile(index, tiles[first + i], tolerances);
      progress.report("finding fine levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
    });
    parallel_for(found.size(), [&](std::size_t i) {
      given_there[i] = write_levels_of_tile(index, tiles[first + i], found[i].levels);
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].blocks.empty()) continue;
      with_posts.push_back(tiles[first + i]);
      for (const auto& [place, squares] : found[i].blocks) {
        Block& block = blocks_[found[i].lattice].try_emplace(place, Block{squares}).first->second;
        block.coarsest_level = std::max(block.coarsest_level, found[i].coarsest_level);
      }
      given.insert(given.end(), given_there[i].begin(), given_there[i].end());
    }
  }
  return with_posts;
}

/// Makes posts that have a coarser level than those that are fine about them posts of the coarsest one, and counts
/// posts by their fine levels.
void PostHierarchy::cut_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles) {
  std::vector<std::vector<std::uint64_t>> posts(tiles.size(), std::vector<std::uint64_t>(posts_.size(), 0));
  parallel_for(tiles.size(), [&](std::size_t i) {
    std::vector<RawPoint> points = index.read(tiles[i]);
    for (RawPoint& p : points) {
      if (p.level == kDropped) continue;
      const int coarsest = coarsest_level_at(position_of(p.code));
      posts[i][static_cast<std::size_t>(coarsest)] += 1;
      p.level = std::min(p.level, static_cast<std::uint16_t>(coarsest));
    }
    index.write(tiles[i], points);
  });
  for (const std::vector<std::uint64_t>& of_tile : posts)
    for (std::size_t k = 1; k < posts_.size(); ++k) posts_[k] += of_tile[k];
  for (std::size_t k = posts_.size(); k-- > 2;) posts_[k - 1] += posts_[k];
}

int PostHierarchy::coarsest_level_at(Position p) const {
  int coarsest = 0;
  for (const auto& [lattice, blocks] : blocks_) {
    const auto place = lattice.place_of(p);
    if (!place) continue;
    // Posts on a block's sides belong to two blocks, and its corners to four.
    const auto& [c, r] = *place;
    for (std::int64_t row = block_of(r - 1); row <= block_of(r); ++row) {
      for (std::int64_t column = block_of(c - 1); column <= block_of(c); ++column) {
        const auto block = blocks.find({column, row});
        if (block != blocks.end() && block->second.squares.has_corner(c - column * kBlockSide, r - row * kBlockSide))
          coarsest = std::max(coarsest, block->second.coarsest_level);
      }
    }
  }
  return coarsest;
}

int PostHierarchy::coarsest_level_of_block(const PostLattice& lattice, const LatticePlace& block) const {
  const auto blocks = blocks_.find(lattice);
  if (blocks == blocks_.end()) return 0;
  const auto found = blocks->second.find(block);
  return found == blocks->second.end() ? 0 : found->second.coarsest_level;
}

/// Returns the coarsest fine level of the level square with this lower left post and sides of so many steps; 0 where
/// the square is not sound.
int PostHierarchy::coarsest_level_in(const Blocks& blocks, std::int64_t column, std::int64_t row, std::int64_t side) {
  const LatticePlace place{block_of(column), block_of(row)};
  const auto block = blocks.find(place);
  const bool sound = block != blocks.end() &&
                     block->second.squares.has(column - place.column * kBlockSide, row - place.row * kBlockSide, side);
  return sound ? block->second.coarsest_level : 0;
}

std::vector<LevelRaise> PostHierarchy::closing(std::span<const LevelRaise> raises) const {
  std::map<std::uint64_t, int> needed;
  for (const auto& [lattice, blocks] : blocks_) {
    std::vector<LevelRaise> open(raises.begin(), raises.end());
    while (!open.empty()) {
      std::vector<LevelRaise> next;
      for (const LevelRaise& post : open) {
        for (const LevelRaise& corner : corners_needed(lattice, blocks, post)) {
          int& known = needed[corner.code];
          if (known < corner.level) known = corner.level, next.push_back(corner);
        }
      }
      open = std::move(next);
    }
  }
  std::vector<LevelRaise> result;
  for (const auto& [code, level] : needed) result.push_back({code, level});
  return result;
}

/// The corners that a post needs of the sound halves of its square, at the fine levels that are there.
std::vector<LevelRaise> PostHierarchy::corners_needed(const PostLattice& lattice, const Blocks& blocks,
                                                      const LevelRaise& post) {
  std::vector<LevelRaise> corners;
  const auto place = lattice.place_of(position_of(post.code));
  if (!place) return corners;
  const PostSquare square = square_about(*place);
  if (square.half == 0) return corners;
  for (const LatticePlace& half : halves_of(*place, square)) {
    const int coarsest = coarsest_level_in(blocks, half.column - square.half, half.row - square.half, 2 * square.half);
    const int level = std::min(post.level, coarsest);
    if (level == 0) continue;
    for (const auto& [c, r] : corners_in_half(*place, square, half))
      corners.push_back({morton(static_cast<std::int32_t>(lattice.x + c * lattice.step_x),
                                static_cast<std::int32_t>(lattice.y + r * lattice.step_y)),
                         level});
  }
  return corners;
}

}  // namespace itin
