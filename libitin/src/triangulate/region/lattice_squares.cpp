#include "triangulate/region/lattice_squares.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace itin {

namespace {

constexpr std::uint32_t kNone = kNoTriangle;
/// Bounds the nodes of a lattice: beyond a certain size, lattices with more gaps than posts are left alone.
constexpr std::size_t kMostNodesPerPost = 4;
/// A value is a column only if it has at least this part of the posts that columns usually have; otherwise its points
/// are vertices of lines.
constexpr std::uint32_t kLeastPart = 4;

/// Counts how often each value of one coordinate comes. Then chooses the values that are columns (or rows), and numbers
/// them.
class Values {
 public:
  /// Counts the values. Returns false when there are more different ones than `most`.
  bool count(std::span<const Position> positions, std::int32_t Position::*axis, std::size_t most) {
    for (const Position& p : positions) {
      Slot& slot = slot_of(p.*axis);
      slot.value = p.*axis;
      if (slot.number++ > 0) continue;
      if (++used_ > most) return false;
      if (2 * used_ > slots_.size()) grow();
    }
    return true;
  }

  /// Returns the chosen values, ascending.
  std::vector<std::int32_t> choose() {
    const std::uint32_t least = count_at_median() / kLeastPart;
    std::vector<std::int32_t> chosen;
    for (const Slot& slot : slots_) {
      if (slot.number > 0 && slot.number >= least) chosen.push_back(slot.value);
    }
    std::sort(chosen.begin(), chosen.end());
    slots_.assign(slots_.size(), Slot{});
    for (std::uint32_t i = 0; i < chosen.size(); ++i) slot_of(chosen[i]) = {chosen[i], i + 1};
    return chosen;
  }
  /// Returns the number of a chosen value; kNone for others.
  std::uint32_t number(std::int32_t value) { return slot_of(value).number - 1; }

 private:
  struct Slot {
    std::int32_t value = 0;
    std::uint32_t number = 0;  ///< 0: free
  };

  Slot& slot_of(std::int32_t value) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (static_cast<std::uint32_t>(value) * 2654435769U) >> shift_;
    while (slots_[i].number != 0 && slots_[i].value != value) i = (i + 1) & mask;
    return slots_[i];
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    --shift_;
    for (const Slot& slot : old) {
      if (slot.number > 0) slot_of(slot.value) = slot;
    }
  }

  /// Returns how often the value of the median position comes.
  std::uint32_t count_at_median() const {
    std::vector<std::uint32_t> counts;
    for (const Slot& slot : slots_) {
      if (slot.number > 0) counts.push_back(slot.number);
    }
    std::sort(counts.begin(), counts.end());
    const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    std::uint64_t sum = 0;
    for (const std::uint32_t count : counts) {
      if (2 * (sum += count) >= all) return count;
    }
    return 0;
  }

  static constexpr int kFirstBits = 10;
  int shift_ = 32 - kFirstBits;
  std::vector<Slot> slots_ = std::vector<Slot>(std::size_t{1} << kFirstBits);
  std::size_t used_ = 0;
};

std::int32_t median_step(const std::vector<std::int32_t>& values) {
  std::vector<std::int32_t> steps(values.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = values[i + 1] - values[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

struct Range {
  std::size_t first, end;
};

/// Returns the interval between neighbours of the values from `first` to `last` that holds a third of `thrice`.
std::size_t interval(const std::vector<std::int32_t>& values, std::int64_t thrice, std::size_t first,
                     std::size_t last) {
  const auto begin = values.begin();
  const auto after =
      std::upper_bound(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last), thrice,
                       [](std::int64_t t, std::int32_t value) { return t < 3 * std::int64_t{value}; });
  return static_cast<std::size_t>(after - begin) - 1;
}

/// Returns the intervals between neighbouring values that meet [low, high].
Range intervals(const std::vector<std::int32_t>& values, double low, double high) {
  const auto from = std::lower_bound(values.begin(), values.end(), low) - values.begin();
  const auto to = std::upper_bound(values.begin(), values.end(), high) - values.begin();
  return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(from, 1) - 1),
          std::min(static_cast<std::size_t>(to), values.size() - 1)};
}

}  // namespace

LatticeSquares::LatticeSquares(std::span<const Position> positions, std::span<const Segment> segments,
                               const GridBox& known) {
  if (place(positions)) {
    mark_full(known);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!nodes_[i].exists()) clear_about(positions[i]);
    }
    for (const Segment& s : segments) clear_along(s);
    number_triangles();
  }
  if (count_ == 0) nodes_.assign(positions.size(), {});
  find_rest(segments);
}

/// Places the positions on a lattice. Returns false when they form none.
bool LatticeSquares::place(std::span<const Position> positions) {
  Values x, y;
  const std::size_t most = positions.size() / 2 + 256;
  if (!x.count(positions, &Position::x, most) || !y.count(positions, &Position::y, most)) return false;
  columns_ = x.choose(), rows_ = y.choose();
  if (columns_.size() < 2 || rows_.size() < 2) return false;
  if (columns_.size() * rows_.size() > kMostNodesPerPost * positions.size()) return false;
  column_step_ = median_step(columns_), row_step_ = median_step(rows_);
  vertices_.assign(columns_.size() * rows_.size(), kNone);
  nodes_.assign(positions.size(), {});
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const std::uint32_t column = x.number(positions[i].x), row = y.number(positions[i].y);
    if (column == kNone || row == kNone) continue;
    nodes_[i] = {column, row};
    vertices_[node(column, row)] = i;
  }
  return true;
}

/// Marks the full squares: those with all four posts. A square's circle lies in the square widened by half its height
/// sideways, and by half its width upwards and downwards, as the radius is less than half the sum of both; that area
/// must be known. Squares of more than twice the usual width or height are left alone, which bounds how far circles
/// reach.
void LatticeSquares::mark_full(const GridBox& known) {
  first_.assign(vertices_.size(), kNone);
  for (std::size_t row = 0; row + 1 < rows_.size(); ++row) {
    const std::int64_t south = rows_[row], north = rows_[row + 1];
    if (north - south > 2 * std::int64_t{row_step_}) continue;
    if (south - column_step_ < known.ymin || north + column_step_ > known.ymax) continue;
    for (std::size_t column = 0; column + 1 < columns_.size(); ++column) {
      const std::size_t n = node(column, row), above = node(column, row + 1);
      if (vertices_[n] == kNone || vertices_[n + 1] == kNone || vertices_[above] == kNone ||
          vertices_[above + 1] == kNone)
        continue;
      const std::int64_t west = columns_[column], east = columns_[column + 1];
      if (east - west > 2 * std::int64_t{column_step_}) continue;
      if (west - row_step_ < known.xmin || east + row_step_ > known.xmax) continue;
      first_[n] = 0;
    }
  }
}

/// Unmarks the squares whose circles may hold a position off the lattice.
void LatticeSquares::clear_about(Position p) {
  const Range columns = intervals(columns_, double{1} * p.x - row_step_, double{1} * p.x + row_step_);
  const Range rows = intervals(rows_, double{1} * p.y - column_step_, double{1} * p.y + column_step_);
  for (std::size_t row = rows.first; row < rows.end; ++row)
    for (std::size_t column = columns.first; column < columns.end; ++column) first_[node(column, row)] = kNone;
}

/// Unmarks the squares that a segment crosses; it may run along their sides.
void LatticeSquares::clear_along(const Segment& s) {
  const Position a = s.a(), b = s.b();
  const double low = std::min(a.y, b.y), high = std::max(a.y, b.y), west = std::min(a.x, b.x),
               east = std::max(a.x, b.x);
  const double slope = a.y == b.y ? 0 : (double{1} * b.x - a.x) / (double{1} * b.y - a.y);
  const Range rows = intervals(rows_, low, high);
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    const std::int32_t south = rows_[row], north = rows_[row + 1];
    double x0 = west, x1 = east;
    if (slope != 0) {
      x0 = a.x + slope * (std::clamp<double>(south, low, high) - a.y);
      x1 = a.x + slope * (std::clamp<double>(north, low, high) - a.y);
      if (x1 < x0) std::swap(x0, x1);
    }
    // A step of slack absorbs the rounding; the exact test decides.
    const Range columns = intervals(columns_, x0 - 1, x1 + 1);
    for (std::size_t column = columns.first; column < columns.end; ++column) {
      const std::int32_t left = columns_[column], right = columns_[column + 1];
      if (east <= left || west >= right || high <= south || low >= north) continue;
      const auto [least, greatest] =
          std::minmax({orientation(a, b, Position{left, south}), orientation(a, b, Position{right, south}),
                       orientation(a, b, Position{left, north}), orientation(a, b, Position{right, north})});
      if (least < 0 && greatest > 0) first_[node(column, row)] = kNone;
    }
  }
}

void LatticeSquares::number_triangles() {
  for (std::uint32_t& first : first_) {
    if (first == kNone) continue;
    first = count_;
    count_ += 2;
  }
}

std::size_t LatticeSquares::node_at(Position p) const {
  const auto column = std::lower_bound(columns_.begin(), columns_.end(), p.x);
  const auto row = std::lower_bound(rows_.begin(), rows_.end(), p.y);
  if (column == columns_.end() || row == rows_.end() || *column != p.x || *row != p.y) return kNone;
  return node(static_cast<std::size_t>(column - columns_.begin()), static_cast<std::size_t>(row - rows_.begin()));
}

void LatticeSquares::find_rest(std::span<const Segment> segments) {
  std::vector<std::size_t> ends;
  if (count_ > 0) {
    for (const Segment& s : segments) {
      for (const Position p : s.ends()) ends.push_back(node_at(p));
    }
    std::sort(ends.begin(), ends.end());
  }
  const auto surrounded = [&](std::size_t n) {
    const std::size_t width = columns_.size();
    return n > width && first_[n] != kNone && first_[n - 1] != kNone && first_[n - width] != kNone &&
           first_[n - width - 1] != kNone && !std::binary_search(ends.begin(), ends.end(), n);
  };
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i].exists() || !surrounded(node(nodes_[i].column, nodes_[i].row))) rest_.push_back(i);
  }
}

namespace {

/// The two triangles of a square. Beyond edges 0, 1 and 2, the lower left triangle has the upper right one, the square
/// to the left and the square below. The upper right triangle has the square above, the lower left one and the square
/// to the right.
constexpr std::uint32_t kLowerLeft = 0, kUpperRight = 1;

}  // namespace

void LatticeSquares::add_squares(PlaneMesh& mesh) const {
  const std::size_t width = columns_.size();
  const auto beyond = [&](bool there, std::size_t n, std::uint32_t which) {
    return !there || first_[n] == kNone ? kNone : first_[n] + which;
  };
  for (std::size_t n = 0; n < first_.size(); ++n) {
    if (first_[n] == kNone) continue;
    const std::uint32_t a = vertices_[n], b = vertices_[n + 1], c = vertices_[n + width + 1], d = vertices_[n + width];
    mesh.triangles.push_back({a, b, d});
    mesh.neighbours.push_back({first_[n] + kUpperRight, beyond(n % width != 0, n - 1, kUpperRight),
                               beyond(n >= width, n - width, kUpperRight)});
    mesh.triangles.push_back({b, c, d});
    // No square stands to the upper right of the last column or row.
    mesh.neighbours.push_back(
        {beyond(true, n + width, kLowerLeft), first_[n] + kLowerLeft, beyond(true, n + 1, kLowerLeft)});
  }
}

void LatticeSquares::fill(PlaneMesh& mesh) const {
  if (count_ == 0) return;
  PlaneMesh all;
  all.triangles.reserve(mesh.triangles.size() + count_);
  all.neighbours.reserve(mesh.triangles.size() + count_);
  add_squares(all);
  std::vector<std::uint32_t> numbers(mesh.triangles.size(), kNone);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (covers(mesh.triangles[t])) continue;
    numbers[t] = count_ + static_cast<std::uint32_t>(kept.size());
    kept.push_back(t);
  }
  for (const std::uint32_t t : kept) {
    all.triangles.push_back(mesh.triangles[t]);
    all.neighbours.push_back(mesh.neighbours[t]);
    for (unsigned i = 0; i < 3; ++i) {
      std::uint32_t& neighbour = all.neighbours.back()[i];
      if (neighbour == kNone) continue;
      neighbour = numbers[neighbour];
      if (neighbour == kNone) link(all, numbers[t], i);
    }
  }
  mesh = std::move(all);
}

/// Tells whether a triangle of posts lies in full squares. Their border is made of edges, so its centroid decides.
bool LatticeSquares::covers(const std::array<std::uint32_t, 3>& triangle) const {
  std::int64_t x = 0, y = 0;
  std::uint32_t west = kNone, east = 0, south = kNone, north = 0;
  for (const std::uint32_t v : triangle) {
    if (v >= nodes_.size() || !nodes_[v].exists()) return false;
    const auto [column, row] = nodes_[v];
    x += columns_[column], y += rows_[row];
    west = std::min(west, column), east = std::max(east, column);
    south = std::min(south, row), north = std::max(north, row);
  }
  return first_[node(interval(columns_, x, west, east), interval(rows_, y, south, north))] != kNone;
}

/// Makes a triangle and the square beyond its edge neighbours.
void LatticeSquares::link(PlaneMesh& mesh, std::uint32_t triangle, unsigned edge) const {
  const auto& corners = mesh.triangles[triangle];
  const auto [p_column, p_row] = nodes_[corners[(edge + 1) % 3]];
  const auto [q_column, q_row] = nodes_[corners[(edge + 2) % 3]];
  const std::size_t p = node(p_column, p_row), q = node(q_column, q_row), width = columns_.size();
  std::uint32_t neighbour = kNone;
  unsigned side = 0;
  // The square is to the right of pq.
  if (q == p + 1) {  // eastwards
    neighbour = first_[p - width] + kUpperRight, side = 0;
  } else if (p == q + 1) {
    neighbour = first_[q] + kLowerLeft, side = 2;
  } else if (q == p + width) {  // northwards
    neighbour = first_[p] + kLowerLeft, side = 1;
  } else {
    neighbour = first_[q - 1] + kUpperRight, side = 2;
  }
  mesh.neighbours[triangle][edge] = neighbour;
  mesh.neighbours[neighbour][side] = triangle;
}

}  // namespace itin
