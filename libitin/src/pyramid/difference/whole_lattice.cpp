#include "pyramid/difference/whole_lattice.hpp"

#include <algorithm>
#include <limits>

#include "geometry/whole_division.hpp"
#include "store/prevailing_lattice.hpp"

namespace itin {

namespace {

constexpr std::int32_t kMissing = std::numeric_limits<std::int32_t>::min();

/// Posts of one axis: the first one and their number, among origin + i step.
struct Extent {
  std::int64_t first = 0, count = 0;
};

/// The posts within [least, greatest], where all data ends, that squares at [from, to] have.
std::optional<Extent> extent(std::int64_t origin, std::int64_t step, std::int64_t from, std::int64_t to,
                             std::int64_t least, std::int64_t greatest) {
  const std::int64_t first = std::max(ceil_divide(from - step - origin, step), ceil_divide(least - origin, step)),
                     last = std::min(floor_divide(to + step - origin, step), floor_divide(greatest - origin, step));
  const std::int64_t low = origin + first * step, high = origin + last * step;
  // Where ground ends before the interval does, all ground must end there.
  if ((low >= from && low != least) || (high <= to && high != greatest) || last - first < 1) return std::nullopt;
  return Extent{low, last - first + 1};
}

}  // namespace

std::optional<WholeLattice> WholeLattice::about(const PointIndex& index, const GridBox& box) {
  if (box.empty()) return std::nullopt;
  WholeLattice lattice;
  std::vector<Leaf> leaves;
  index.leaves({}, box, leaves);
  const GridBox all = index.bounds();
  if (!lattice.find_steps(index, leaves) || !lattice.find_extent(box, all)) return std::nullopt;
  // The circle about a square reaches less than a step beyond it.
  const GridBox near = expanded(lattice.bounds(), static_cast<double>(std::max(lattice.step_x_, lattice.step_y_)));
  if (lattice.is_crossed(index, near, all) || !lattice.read(index, near)) return std::nullopt;
  lattice.find_corners(box);
  return lattice;
}

/// Guesses the steps from leaves; read() finds out whether they are right.
bool WholeLattice::find_steps(const PointIndex& index, const std::vector<Leaf>& leaves) {
  const std::optional<PostLattice> lattice = prevailing_lattice(index, leaves, index.bounds());
  if (!lattice) return false;
  west_ = lattice->x, south_ = lattice->y;
  step_x_ = lattice->step_x, step_y_ = lattice->step_y;
  return true;
}

bool WholeLattice::find_extent(const GridBox& box, const GridBox& all) {
  const auto across = extent(west_, step_x_, box.xmin, box.xmax, all.xmin, all.xmax);
  const auto along = extent(south_, step_y_, box.ymin, box.ymax, all.ymin, all.ymax);
  constexpr std::int64_t kMost = std::int64_t{1} << 20;
  if (!across || !along || across->count * along->count > kMost) return false;
  west_ = across->first, south_ = along->first;
  columns_ = static_cast<std::int32_t>(across->count), rows_ = static_cast<std::int32_t>(along->count);
  return true;
}

/// Tells whether segments cross the lattice: only the sides of the lattice where all ground ends may be segments.
bool WholeLattice::is_crossed(const PointIndex& index, const GridBox& near, const GridBox& all) const {
  std::vector<Segment> segments;
  index.segments(near, segments);
  const GridBox own = bounds();
  return std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
    if (!extent_of(s).meets(own)) return false;
    const bool at_side =
        s.ax == s.bx ? s.ax == all.xmin || s.ax == all.xmax : s.ay == s.by && (s.ay == all.ymin || s.ay == all.ymax);
    return s.theme != kCoverage || !at_side;
  });
}

bool WholeLattice::read(const PointIndex& index, const GridBox& near) {
  heights_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kMissing);
  std::vector<Leaf> leaves;
  index.leaves({}, near, leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = index.block(leaf);
    for (const GridPoint& p : block->points) {
      if (!near.contains(p.x, p.y)) continue;
      const auto at = place({p.x, p.y});
      if (!at) return false;
      if (at->column < 0 || at->column >= columns_ || at->row < 0 || at->row >= rows_) continue;
      heights_[post(static_cast<std::int32_t>(at->column), static_cast<std::int32_t>(at->row))] = p.z;
    }
  }
  const auto [least, greatest] = std::minmax_element(heights_.begin(), heights_.end());
  range_ = {*least, *greatest};
  return *least != kMissing;
}

void WholeLattice::find_corners(const GridBox& box) {
  // Positive above, and negative below, the line of the diagonal of a square with this corner.
  const auto above_diagonal = [&](std::int64_t x, std::int64_t y, std::int64_t west, std::int64_t south) {
    return (x - west) * step_y_ + (y - south) * step_x_ - step_x_ * step_y_;
  };
  const GridBox own = bounds();
  last_meets_ = above_diagonal(std::min(box.xmax, own.xmax), std::min(box.ymax, own.ymax), own.xmax - step_x_,
                               own.ymax - step_y_) >= 0;
  first_meets_ = above_diagonal(std::max(box.xmin, own.xmin), std::max(box.ymin, own.ymin), west_, south_) <= 0;
}

GridBox WholeLattice::bounds() const {
  const Position first = position({0, 0}), last = position({columns_ - 1, rows_ - 1});
  return {first.x, first.y, last.x, last.y};
}

Position WholeLattice::position(Place place) const {
  return {static_cast<std::int32_t>(west_ + place.column * step_x_),
          static_cast<std::int32_t>(south_ + place.row * step_y_)};
}

std::optional<WholeLattice::Place> WholeLattice::place(Position p) const {
  const std::int64_t x = p.x - west_, y = p.y - south_;
  if (x % step_x_ != 0 || y % step_y_ != 0) return std::nullopt;
  return Place{x / step_x_, y / step_y_};
}

namespace {

/// Finds which of `count` intervals between posts meet [from, to].
std::pair<std::int32_t, std::int32_t> intervals(std::int64_t from, std::int64_t to, std::int64_t step,
                                                std::int32_t count) {
  const auto inside = [&](std::int64_t i) { return static_cast<std::int32_t>(std::clamp<std::int64_t>(i, 0, count)); };
  return {inside(ceil_divide(from, step) - 1), inside(floor_divide(to, step) + 1)};
}

}  // namespace

std::pair<std::int32_t, std::int32_t> WholeLattice::square_columns(std::int32_t from, std::int32_t to) const {
  return intervals(from - west_, to - west_, step_x_, columns_ - 1);
}

std::pair<std::int32_t, std::int32_t> WholeLattice::square_rows(std::int32_t from, std::int32_t to) const {
  return intervals(from - south_, to - south_, step_y_, rows_ - 1);
}

}  // namespace itin
