#include "pyramid/levels/post_window.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "geometry/whole_division.hpp"
#include "store/prevailing_lattice.hpp"
#include "triangulate/region/region_reader.hpp"

namespace itin {

namespace {

constexpr std::int32_t kNoPost = std::numeric_limits<std::int32_t>::min();
/// Blocks with greater differences in height are passed over: sums of heights must fit in 32 bits.
constexpr std::int64_t kGreatestRise = 1 << 21;
/// Tiles whose blocks have far more places than points are passed over: their points are no raster's.
constexpr std::int64_t kPlacesPerPoint = 8, kFewPlaces = 1 << 18;

/// The leaves at a box and beside it: a box with a single row of posts does not know the distance between rows.
std::vector<Leaf> leaves_about(const WorkingIndex& index, const GridBox& box) {
  std::vector<Leaf> leaves;
  index.leaves({}, box, leaves);
  double side = 0;
  for (const Leaf& leaf : leaves) side = std::max(side, std::ldexp(1.0, leaf.cell.log2_side));
  leaves.clear();
  index.leaves({}, expanded(box, side), leaves);
  return leaves;
}

/// Adds the differences of a row's posts from a plane: `times` its height at post u is `at_0` + u `rise`.
void compare(const std::int32_t* row, std::int32_t base, std::int32_t from, std::int32_t to, std::int32_t at_0,
             std::int32_t rise, SquareDifference& difference) {
  std::int32_t least = difference.least_at_posts, greatest = difference.greatest_at_posts;
  const std::int32_t times = difference.times;
  for (std::int32_t u = from; u <= to; ++u) {
    const std::int32_t above = times * (row[u] - base) - at_0 - u * rise;
    least = std::min(least, above), greatest = std::max(greatest, above);
  }
  difference.least_at_posts = least, difference.greatest_at_posts = greatest;
}

void add_crossing(std::int32_t above, SquareDifference& difference) {
  difference.crosses = true;
  difference.least_at_crossings = std::min(difference.least_at_crossings, above);
  difference.greatest_at_crossings = std::max(difference.greatest_at_crossings, above);
}

}  // namespace

bool SquareDifference::keeps_to(std::int32_t tolerance) const {
  const std::int64_t most = std::int64_t{times} * tolerance;
  return std::max(-least_at_posts, greatest_at_posts) <= most &&
         (!crosses || std::max(-least_at_crossings, greatest_at_crossings) < 2 * most);
}

DifferenceRange SquareDifference::range() const {
  DifferenceRange range{floor_divide(least_at_posts, times), ceil_divide(greatest_at_posts, times)};
  if (crosses)
    range.add({floor_divide(least_at_crossings - 1, 2 * times), ceil_divide(greatest_at_crossings + 1, 2 * times)});
  return range;
}

std::optional<PostWindow> PostWindow::about(const WorkingIndex& index, const CurveRange& tile) {
  PostWindow window;
  if (!window.find_blocks(index, intersection(square_of(tile.cell), index.bounds()), tile.count)) return std::nullopt;
  window.read(index);
  window.find_sound_squares();
  return window;
}

/// Returns whether the box has a lattice that its points may fill.
bool PostWindow::find_blocks(const WorkingIndex& index, const GridBox& box, std::int64_t points) {
  if (box.empty()) return false;
  // All leaves vote: the fullest may have a single column, as at a raster's end, or a point that is no post.
  const std::vector<Leaf> leaves = leaves_about(index, box);
  const auto lattice = prevailing_lattice(index, leaves, index.bounds(), leaves.size());
  if (!lattice || lattice->step_x != lattice->step_y) return false;
  lattice_ = lattice->from_first_place();
  const std::int64_t side = kBlockSide * lattice_.step_x;
  const auto block = [&](std::int64_t v, std::int64_t origin) { return floor_divide(v - origin, side); };
  // The posts on a block's sides belong to two blocks.
  const std::int64_t west = block(box.xmin - 1, lattice_.x), east = block(box.xmax, lattice_.x),
                     south = block(box.ymin - 1, lattice_.y), north = block(box.ymax, lattice_.y);
  const std::int64_t places = (east - west + 1) * (north - south + 1) * kBlockSide * kBlockSide;
  if (places > kPlacesPerPoint * points + kFewPlaces) return false;
  first_ = {west - 1, south - 1};
  columns_ = east - west + 3, rows_ = north - south + 3;
  return true;
}

/// Reads the heights of all posts, and finds the single squares that have something else.
void PostWindow::read(const WorkingIndex& index) {
  heights_.assign(post(0, up() + 1), kNoPost);
  levels_.assign(heights_.size(), 0);
  sound_.emplace_back(static_cast<std::size_t>(across() * up()), 1);
  const GridBox box = box_of_squares(0, 0, across(), up());
  std::vector<Leaf> leaves;
  index.leaves({}, box, leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = index.block(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (!box.contains(p.x, p.y)) continue;
      if (const auto place = place_of({p.x, p.y})) {
        heights_[post(*place)] = p.z;
        levels_[post(*place)] = level_of(leaf, *block, k);
      } else {
        spoil({p.x, p.y, p.x, p.y}, [](const GridBox&) { return true; });
      }
    }
  }
  std::vector<Segment> segments;
  index.segments(box, segments);
  for (const Segment& s : segments) {
    // The outline of the ground runs along sides and diagonals.
    if (s.theme == kCoverage) continue;
    spoil(extent_of(s), [&](const GridBox& square) { return meets(s.a(), s.b(), square); });
  }
}

/// Spoils the single squares at the box for which met(square) holds.
template <class Met>
void PostWindow::spoil(const GridBox& box, const Met& met) {
  const std::int64_t step = lattice_.step_x;
  const std::int64_t west = std::max<std::int64_t>(ceil_divide(box.xmin - origin_x(), step) - 1, 0),
                     east = std::min(floor_divide(box.xmax - origin_x(), step), across() - 1),
                     south = std::max<std::int64_t>(ceil_divide(box.ymin - origin_y(), step) - 1, 0),
                     north = std::min(floor_divide(box.ymax - origin_y(), step), up() - 1);
  for (std::int64_t r = south; r <= north; ++r)
    for (std::int64_t c = west; c <= east; ++c)
      if (met(box_of_squares(c, r, 1, 1))) sound_[0][static_cast<std::size_t>(r * across() + c)] = 0;
}

/// Finds the sound squares of each size. A block with too great differences in height has none.
void PostWindow::find_sound_squares() {
  for (std::int64_t row = 0; row < rows_; ++row)
    for (std::int64_t column = 0; column < columns_; ++column) find_sound_squares_of_block(column, row);
  for (std::int64_t across = this->across() / 2, up = this->up() / 2; sound_.size() < kSizes; across /= 2, up /= 2) {
    const std::vector<std::uint8_t>& parts = sound_.back();
    std::vector<std::uint8_t> whole(static_cast<std::size_t>(across * up));
    for (std::int64_t r = 0; r < up; ++r) {
      for (std::int64_t c = 0; c < across; ++c) {
        const auto part = static_cast<std::size_t>(4 * r * across + 2 * c),
                   above = part + static_cast<std::size_t>(2 * across);
        whole[static_cast<std::size_t>(r * across + c)] =
            parts[part] & parts[part + 1] & parts[above] & parts[above + 1];
      }
    }
    sound_.push_back(std::move(whole));
  }
}

void PostWindow::find_sound_squares_of_block(std::int64_t column, std::int64_t row) {
  std::int32_t least = std::numeric_limits<std::int32_t>::max(), greatest = kNoPost;
  for (std::int64_t r = row * kBlockSide; r <= (row + 1) * kBlockSide; ++r) {
    for (std::int64_t c = column * kBlockSide; c <= (column + 1) * kBlockSide; ++c) {
      const std::int32_t z = heights_[post(c, r)];
      if (z != kNoPost) least = std::min(least, z), greatest = std::max(greatest, z);
    }
  }
  const bool fits = least <= greatest && std::int64_t{greatest} - least < kGreatestRise;
  for (std::int64_t r = row * kBlockSide; r < (row + 1) * kBlockSide; ++r) {
    for (std::int64_t c = column * kBlockSide; c < (column + 1) * kBlockSide; ++c) {
      const std::size_t south = post(c, r), north = post(c, r + 1);
      if (!fits || heights_[south] == kNoPost || heights_[south + 1] == kNoPost || heights_[north] == kNoPost ||
          heights_[north + 1] == kNoPost)
        sound_[0][static_cast<std::size_t>(r * this->across() + c)] = 0;
    }
  }
}

bool PostWindow::is_sound_about(const LatticePlace& middle, std::int64_t half) const {
  const int size = std::bit_width(static_cast<std::uint64_t>(half));
  return is_sound(static_cast<std::size_t>(size), (middle.column - half) >> size, (middle.row - half) >> size);
}

std::optional<LatticePlace> PostWindow::place_of(Position p) const {
  const auto place = lattice_.place_of(p);
  if (!place) return std::nullopt;
  const std::int64_t c = place->column - first_.column * kBlockSide, r = place->row - first_.row * kBlockSide;
  if (c < 0 || r < 0 || c > across() || r > up()) return std::nullopt;
  return LatticePlace{c, r};
}

GridBox PostWindow::box_of_squares(std::int64_t column, std::int64_t row, std::int64_t across, std::int64_t up) const {
  const auto inside = [](std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kGridHalfSide, kGridHalfSide - 1));
  };
  const std::int64_t step = lattice_.step_x, west = origin_x() + column * step, south = origin_y() + row * step;
  return {inside(west), inside(south), inside(west + across * step), inside(south + up * step)};
}

SquareDifference PostWindow::difference(const LatticePlace& middle, const PostSquare& square, unsigned halves) const {
  const auto half = static_cast<std::int32_t>(square.half);
  return square.kind == SquareKind::kLevel ? over_level_square(middle, half, halves)
                                           : over_upright_square(middle, half, halves);
}

SquareDifference PostWindow::over_level_square(const LatticePlace& middle, std::int32_t half, unsigned halves) const {
  const std::int32_t side = 2 * half;
  const std::size_t above = post(0, 1);
  const std::int32_t* const low = &heights_[post(middle.column - half, middle.row - half)];
  const std::int32_t* const high = low + static_cast<std::size_t>(side) * above;
  const std::int32_t base = low[0], se = low[side] - base, ne = high[side] - base, nw = high[0] - base;
  SquareDifference result;
  result.times = side;
  for (std::int32_t v = 0; v <= side; ++v) {
    const std::int32_t* const row = low + static_cast<std::size_t>(v) * above;
    if (halves & kLowerLeft) compare(row, base, 0, side - v, v * nw, se, result);
    if (halves & kUpperRight)
      compare(row, base, side - v, side, side * (se + nw - ne) + v * (ne - se), ne - nw, result);
    if (halves & kUpperLeft) compare(row, base, 0, v, v * nw, ne - nw, result);
    if (halves & kLowerRight) compare(row, base, v, side, v * (ne - se), se, result);
    // A rising diagonal crosses the lattice's.
    if ((halves & (kUpperLeft | kLowerRight)) == 0 || v == side) continue;
    const std::int32_t twice = row[v + 1] + row[static_cast<std::size_t>(v) + above] - 2 * base;
    add_crossing(side * twice - (2 * v + 1) * ne, result);
  }
  return result;
}

SquareDifference PostWindow::over_upright_square(const LatticePlace& middle, std::int32_t half, unsigned halves) const {
  const std::int32_t side = 2 * half;
  const std::int32_t base = heights_[post(middle)];
  const auto row_at = [&](std::int32_t y) { return &heights_[post(middle.column, middle.row + y)]; };
  const auto has = [&](unsigned any) { return (halves & any) != 0; };
  // A half has both ends of the diagonal that bounds it.
  const std::int32_t w = has(kSouth | kNorth | kWest) ? row_at(0)[-half] - base : 0,
                     e = has(kSouth | kNorth | kEast) ? row_at(0)[half] - base : 0,
                     s = has(kWest | kEast | kSouth) ? row_at(-half)[0] - base : 0,
                     n = has(kWest | kEast | kNorth) ? row_at(half)[0] - base : 0;
  SquareDifference result;
  result.times = side;
  for (std::int32_t y = has(kWest | kEast | kSouth) ? -half : 0; y <= (has(kWest | kEast | kNorth) ? half : 0); ++y) {
    const std::int32_t* const row = row_at(y);
    const std::int32_t width = half - std::abs(y);
    if ((y <= 0 && has(kSouth)) || (y >= 0 && has(kNorth))) {
      const std::int32_t bend = 2 * (y < 0 ? s : n) - w - e;
      compare(row, base, -width, width, half * (w + e) + std::abs(y) * bend, e - w, result);
    }
    const std::int32_t at_middle = half * (s + n) + y * (n - s);
    if (has(kWest)) compare(row, base, -width, 0, at_middle, s + n - 2 * w, result);
    if (has(kEast)) compare(row, base, 0, width, at_middle, 2 * e - s - n, result);
  }
  // The sides that rise cross the lattice's diagonals.
  const auto cross = [&](std::int32_t u, std::int32_t y, std::int32_t from, std::int32_t to) {
    for (std::int32_t t = 0; t < half; ++t) {
      const std::int32_t twice = row_at(y + t)[u + t + 1] + row_at(y + t + 1)[u + t] - 2 * base;
      add_crossing(side * twice - 2 * side * from - (4 * t + 2) * (to - from), result);
    }
  };
  if (has(kSouth | kEast)) cross(0, -half, s, e);
  if (has(kWest | kNorth)) cross(-half, 0, w, n);
  return result;
}

}  // namespace itin
