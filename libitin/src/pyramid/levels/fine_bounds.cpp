#include "pyramid/levels/fine_bounds.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <itin/parallel.hpp>

#include "geometry/marked_squares.hpp"
#include "geometry/whole_division.hpp"
#include "pyramid/levels/post_window.hpp"
#include "triangulate/region/region_reader.hpp"

namespace itin {

namespace {

/// A box of single squares: columns and rows [west, east) and [south, north).
struct Squares {
  std::int64_t west, east, south, north;
};

/// One tile's single squares: what lies over each at one level.
class TileBounds {
 public:
  TileBounds(const WorkingIndex& index, const PostWindow& window)
      : window_(window), clear_(static_cast<std::size_t>(window.across() * window.up())) {
    for (std::int64_t r = 0; r < window.up(); ++r)
      for (std::int64_t c = 0; c < window.across(); ++c) clear_[square(c, r)] = window.is_sound(0, c, r) ? 1 : 0;
    std::vector<Segment> segments;
    index.segments(window.box_of_squares(0, 0, window.across(), window.up()), segments);
    for (const Segment& s : segments) leave_clear_of(s);
    unclear_ = {window.across(), window.up(),
                [&](std::int64_t column, std::int64_t row) { return clear_[square(column, row)] == 0; }};
  }

  void measure(int level) {
    level_ = level;
    ranges_.assign(clear_.size(), {});
    known_ = clear_;
    for (std::int64_t r = 0; r <= window_.up(); ++r)
      for (std::int64_t c = 0; c <= window_.across(); ++c) measure_about({c, r});
    for (std::int64_t r = kBlockSide; r < window_.up() - kBlockSide; ++r) {
      for (std::int64_t c = kBlockSide; c < window_.across() - kBlockSide; ++c) {
        // Elsewhere than in squares without their middle, the level has all posts, and is the full surface, unless
        // that has a point within the circle about the square, which reaches into the squares beside it.
        if (!ranges_[square(c, r)].empty()) continue;
        ranges_[square(c, r)] = {0, 0};
        if (!has({c, r}) || !has({c + 1, r}) || !has({c, r + 1}) || !has({c + 1, r + 1}) ||
            !is_clear({c - 1, c + 2, r - 1, r + 2}))
          known_[square(c, r)] = 0;
      }
    }
  }

  /// The range over a box; empty where it is not known.
  DifferenceRange over(const GridBox& box) const {
    const auto at = squares_at(box);
    DifferenceRange range;
    if (at.west < 0 || at.south < 0 || at.east > window_.across() || at.north > window_.up()) return range;
    for (std::int64_t r = at.south; r < at.north; ++r) {
      for (std::int64_t c = at.west; c < at.east; ++c) {
        if (known_[square(c, r)] == 0) return {};
        range.add(ranges_[square(c, r)]);
      }
    }
    return range;
  }

 private:
  std::size_t square(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * window_.across() + column);
  }
  /// Whether the level has a post.
  bool has(const LatticePlace& place) const { return window_.level(place) >= level_; }

  /// The single squares that meet a box, perhaps beyond the window.
  Squares squares_at(const GridBox& box) const {
    const GridBox all = window_.box_of_squares(0, 0, window_.across(), window_.up());
    const std::int64_t step = window_.lattice().step_x;
    return {ceil_divide(std::int64_t{box.xmin} - all.xmin, step) - 1,
            floor_divide(std::int64_t{box.xmax} - all.xmin, step) + 1,
            ceil_divide(std::int64_t{box.ymin} - all.ymin, step) - 1,
            floor_divide(std::int64_t{box.ymax} - all.ymin, step) + 1};
  }
  Squares within(const Squares& s) const {
    return {std::max<std::int64_t>(s.west, 0), std::min(s.east, window_.across()), std::max<std::int64_t>(s.south, 0),
            std::min(s.north, window_.up())};
  }
  template <class Visit>
  void for_each(const Squares& squares, const Visit& visit) const {
    const Squares s = within(squares);
    for (std::int64_t r = s.south; r < s.north; ++r)
      for (std::int64_t c = s.west; c < s.east; ++c) visit(c, r);
  }

  void leave_clear_of(const Segment& s) {
    for_each(squares_at(extent_of(s)), [&](std::int64_t c, std::int64_t r) {
      if (meets(s.a(), s.b(), window_.box_of_squares(c, r, 1, 1))) clear_[square(c, r)] = 0;
    });
  }

  bool is_clear(const Squares& s) const { return !unclear_.any_in(s.west, s.east, s.south, s.north); }

  /// Measures the level's triangles in the square about a post that the level lacks. Where it has the post, it must
  /// have the square's corners.
  void measure_about(const LatticePlace& middle) {
    const PostSquare square = square_about(middle);
    if (square.half == 0 || !reaches_inner_blocks(middle, square) || !window_.is_post_of_square(middle)) return;
    const std::array<LatticePlace, 2> halves = halves_of(middle, square);
    if (has(middle)) {
      for (const LatticePlace& half : halves)
        if (window_.is_sound_about(half, square.half)) require_corners(middle, square, half);
      return;
    }
    const unsigned there = square.kind == SquareKind::kLevel ? halves_of_level_square(middle, square)
                                                             : halves_of_other(middle, square, halves);
    if (there == 0) return;
    const DifferenceRange range = window_.difference(middle, square, there).range();
    if (square.kind == SquareKind::kLevel) {
      add(about(middle, square.half), range);
    } else {
      add_upright(middle, square.half, there, range);
    }
    // The circle about a level square reaches a little less than a quarter of its side beyond it, and those about
    // single squares at the corners of another one reach into the squares beyond.
    const std::int64_t reach = square.half + (square.kind == SquareKind::kLevel ? (square.half + 1) / 2 : 1);
    if (!is_clear(about(middle, reach)))
      for_each(about(middle, square.half), [&](std::int64_t c, std::int64_t r) { known_[this->square(c, r)] = 0; });
  }

  /// Tells whether the level squares that a square's halves lie in reach the blocks that meet the tile.
  bool reaches_inner_blocks(const LatticePlace& middle, const PostSquare& square) const {
    const std::int64_t reach = 2 * square.half;
    return middle.column + reach > kBlockSide && middle.column - reach < window_.across() - kBlockSide &&
           middle.row + reach > kBlockSide && middle.row - reach < window_.up() - kBlockSide;
  }

  static Squares about(const LatticePlace& middle, std::int64_t reach) {
    return {middle.column - reach, middle.column + reach, middle.row - reach, middle.row + reach};
  }

  void require_corners(const LatticePlace& middle, const PostSquare& square, const LatticePlace& half) {
    for (const LatticePlace& corner : corners_in_half(middle, square, half)) {
      if (has(corner)) continue;
      for_each(about(half, square.half), [&](std::int64_t c, std::int64_t r) { known_[this->square(c, r)] = 0; });
    }
  }

  /// The halves that are triangles of the level: those that have their corners. Where it has all, the tie rule chooses
  /// the diagonal (predicates.hpp): it falls.
  unsigned halves_of_level_square(const LatticePlace& middle, const PostSquare& square) const {
    if (!window_.is_sound_about(middle, square.half)) return 0;
    const auto corners = corners_in_half(middle, square, middle);
    const bool sw = has(corners[0]), se = has(corners[1]), ne = has(corners[2]), nw = has(corners[3]);
    unsigned there = 0;
    if (sw && se && nw) there |= kLowerLeft;
    if (se && ne && nw) there |= kUpperRight;
    if (there != 0) return there;
    if (sw && ne && nw) return kUpperLeft;
    return sw && se && ne ? kLowerRight : 0;
  }

  /// Where the level has all corners of a square with level and plumb diagonals, the tie rule chooses the plumb one.
  unsigned halves_of_other(const LatticePlace& middle, const PostSquare& square,
                           const std::array<LatticePlace, 2>& halves) const {
    const auto is_there = [&](const LatticePlace& half) {
      const auto corners = corners_in_half(middle, square, half);
      return window_.is_sound_about(half, square.half) &&
             std::all_of(corners.begin(), corners.end(), [&](const LatticePlace& corner) { return has(corner); });
    };
    const bool first = is_there(halves[0]), second = is_there(halves[1]);
    if (first && second) return kWest | kEast;
    const bool on_row = square.kind == SquareKind::kOnRow;
    if (first) return on_row ? kSouth : kWest;
    return !second ? 0U : on_row ? kNorth : kEast;
  }

  void add(const Squares& squares, const DifferenceRange& range) {
    for_each(squares, [&](std::int64_t c, std::int64_t r) { ranges_[square(c, r)].add(range); });
  }

  /// Adds a range to the single squares that some halves of a square with level and plumb diagonals meet.
  void add_upright(const LatticePlace& middle, std::int64_t half, unsigned halves, const DifferenceRange& range) {
    const bool west = (halves & kWest) != 0, east = (halves & kEast) != 0, plumb = west || east;
    const std::int64_t south = plumb || (halves & kSouth) != 0 ? -half : 0,
                       north = plumb || (halves & kNorth) != 0 ? half : 0;
    for (std::int64_t y = south; y < north; ++y) {
      const std::int64_t width = y < 0 ? half + y + 1 : half - y;
      const std::int64_t from = plumb && !west ? 0 : -width, to = plumb && !east ? 0 : width;
      add({middle.column + from, middle.column + to, middle.row + y, middle.row + y + 1}, range);
    }
  }

  const PostWindow& window_;
  std::vector<std::uint8_t> clear_;  ///< by single square: its posts alone are there, and no line is near
  MarkedSquares unclear_;            ///< the single squares that are not clear
  int level_ = 0;
  std::vector<DifferenceRange> ranges_;  ///< by single square
  std::vector<std::uint8_t> known_;      ///< by single square: its range is known
};

}  // namespace

std::vector<unsigned> measure_fine_levels(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                          const PostHierarchy& posts, LeafBounds& bounds, Progress& progress) {
  std::vector<unsigned> known(index.ranges().size(), 0);
  if (posts.coarsest_level() == 0) return known;
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    const CurveRange& tile = tiles[i];
    const auto window = PostWindow::about(index, tile);
    if (!window) return;
    TileBounds measured(index, *window);
    for (int k = 1; k <= posts.coarsest_level(); ++k) {
      measured.measure(k);
      for (std::uint32_t leaf = index.leaf_of(tile.cell.code);
           leaf < known.size() && index.ranges()[leaf].cell.code < tile.cell.end(); ++leaf) {
        const DifferenceRange range = measured.over(square_of(index.ranges()[leaf].cell));
        if (range.empty()) continue;
        bounds.at(leaf, k) = range;
        known[leaf] |= 1U << k;
      }
    }
    progress.report("measuring fine levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  return known;
}

}  // namespace itin
