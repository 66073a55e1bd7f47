#include "pyramid/lattice_difference.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/whole_division.hpp"

namespace itin {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
/// Rounding of the difference at a crossing stays below this.
constexpr double kRounding = 1e-5;
/// Whole numbers below it are exact in double precision.
constexpr double kExact = 9e15;

}  // namespace

LatticeDifference::LatticeDifference(WholeLattice posts) : posts_(std::move(posts)) {}

bool LatticeDifference::compare(const RegionMesh& coarse, std::int32_t allowed) {
  if (!place(coarse) || !fits(coarse)) return false;
  allowed_ = allowed;
  failures_.clear();
  const std::size_t count = posts_.post(0, posts_.rows());
  at_post_.assign(count, kUnknown);
  lower_left_.assign(count, {});
  upper_right_.assign(count, {});
  const PlaneMesh& mesh = coarse.mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    compare_posts(mesh.triangles[t]);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t n = mesh.neighbours[t][i];
      if (n == kNoTriangle || t < n) cross_lines(mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3]);
    }
  }
  if (std::find(at_post_.begin(), at_post_.end(), kUnknown) != at_post_.end()) return false;
  leave_out_corners();
  return true;
}

bool LatticeDifference::place(const RegionMesh& coarse) {
  corners_.clear();
  for (const SelectedVertex& v : coarse.vertices) {
    const auto at = posts_.place(v.position());
    if (!at) return false;
    corners_.push_back({at->column, at->row, v.point.z});
  }
  return true;
}

/// Whether products of areas and heights are exact.
bool LatticeDifference::fits(const RegionMesh& coarse) const {
  auto [least, greatest] = posts_.height_range();
  for (const SelectedVertex& v : coarse.vertices) {
    least = std::min(least, v.point.z);
    greatest = std::max(greatest, v.point.z);
  }
  const double rise = static_cast<double>(greatest) - least;
  return std::all_of(coarse.mesh.triangles.begin(), coarse.mesh.triangles.end(), [&](const auto& t) {
    const auto [low_column, high_column] =
        std::minmax({corners_[t[0]].column, corners_[t[1]].column, corners_[t[2]].column});
    const auto [low_row, high_row] = std::minmax({corners_[t[0]].row, corners_[t[1]].row, corners_[t[2]].row});
    // The last summand keeps the steps from post to post within 64 bits.
    const double width = static_cast<double>(high_column - low_column),
                 height = static_cast<double>(high_row - low_row);
    return width * height * rise < kExact / 4 && (width + height) * (width + height) * rise < 1e18;
  });
}

/// Difference times doubled area is a whole number, and so their quotient is exact where it is whole, and lies between
/// the right whole numbers elsewhere.
void LatticeDifference::compare_posts(const std::array<std::uint32_t, 3>& face) {
  const Corner &a = corners_[face[0]], &b = corners_[face[1]], &c = corners_[face[2]];
  const std::int64_t bx = b.column - a.column, by = b.row - a.row, bz = b.z - a.z, cx = c.column - a.column,
                     cy = c.row - a.row, cz = c.z - a.z;
  const std::int64_t area = bx * cy - by * cx, rise_x = bz * cy - cz * by, rise_y = cz * bx - bz * cx;
  const auto divisor = static_cast<double>(area);
  WorstVertex worst;
  const std::int64_t south = std::max<std::int64_t>(std::min({a.row, b.row, c.row}), 0),
                     north = std::min<std::int64_t>(std::max({a.row, b.row, c.row}), posts_.rows() - 1);
  for (std::int64_t row = south; row <= north; ++row) {
    std::int64_t west = std::numeric_limits<std::int64_t>::max(), east = std::numeric_limits<std::int64_t>::min();
    const auto side = [&](const Corner& p, const Corner& q) {
      const auto& [low, high] = p.row < q.row ? std::tie(p, q) : std::tie(q, p);
      if (low.row == high.row || row < low.row || row > high.row) return;
      const std::int64_t rows = high.row - low.row, across = (high.column - low.column) * (row - low.row);
      west = std::min(west, low.column + ceil_divide(across, rows));
      east = std::max(east, low.column + floor_divide(across, rows));
    };
    side(a, b), side(b, c), side(c, a);
    west = std::max<std::int64_t>(west, 0), east = std::min<std::int64_t>(east, posts_.columns() - 1);
    std::int64_t plane = (west - a.column) * rise_x + (row - a.row) * rise_y;
    for (std::int64_t column = west; column <= east; ++column, plane += rise_x) {
      const std::int64_t z = height(column, row);
      const double above = static_cast<double>((z - a.z) * area - plane) / divisor;
      at_post_[post(column, row)] = above;
      if (std::abs(above) > allowed_ && !is_left_out({column, row}))
        worst.add(static_cast<std::int32_t>(std::ceil(std::abs(above))), code_of(posts_.position({column, row})));
    }
  }
  if (worst.found()) failures_.worst_of_faces.push_back(worst.code());
}

/// Calls edge_at(line, place) for each of the lattice's lines in [least, greatest] that lies strictly between `from`
/// and `to`, and which a coarse edge from `start` on the first to `end` on the last crosses between two posts: at
/// place.first plus place.second. Adds the difference to what it returns.
template <class EdgeAt>
void LatticeDifference::cross_family(std::int64_t from, std::int64_t to, std::int64_t start, std::int64_t end,
                                     std::int64_t least, std::int64_t greatest, double from_z, double to_z,
                                     const EdgeAt& edge_at) {
  if (from > to) std::swap(from, to), std::swap(start, end), std::swap(from_z, to_z);
  const std::int64_t lines = to - from;
  for (std::int64_t line = std::max(from + 1, least); line <= std::min(to - 1, greatest); ++line) {
    const std::int64_t across = (end - start) * (line - from), whole = floor_divide(across, lines),
                       rest = across - whole * lines;
    if (rest == 0) continue;  // at a post
    const double part = static_cast<double>(rest) / static_cast<double>(lines);
    const double z = from_z + static_cast<double>(line - from) / static_cast<double>(lines) * (to_z - from_z);
    edge_at(line, start + whole, part, z);
  }
}

void LatticeDifference::cross_lines(std::uint32_t from, std::uint32_t to) {
  const Corner &a = corners_[from], &b = corners_[to];
  const std::int64_t columns = posts_.columns(), rows = posts_.rows();
  const auto za = static_cast<double>(a.z), zb = static_cast<double>(b.z);
  const auto between = [](double p, double q, double part) { return p + part * (q - p); };
  const auto fails = [&](double above) { return std::abs(above) + kRounding > allowed_; };
  // Columns: the side to the left of one square and to the right of another.
  cross_family(
      a.column, b.column, a.row, b.row, 0, columns - 1, za, zb,
      [&](std::int64_t column, std::int64_t row, double part, double z) {
        if (row < 0 || row >= rows - 1) return;
        const double above = between(height(column, row), height(column, row + 1), part) - z;
        if (column < columns - 1) lower_left_[post(column, row)].add(above);
        if (column > 0) upper_right_[post(column - 1, row)].add(above);
        if (fails(above))
          note_failure(from, to, {{column, row}, {column, row + 1}, {column + 1, row}, {column - 1, row + 1}}, above);
      });
  cross_family(
      a.row, b.row, a.column, b.column, 0, rows - 1, za, zb,
      [&](std::int64_t row, std::int64_t column, double part, double z) {
        if (column < 0 || column >= columns - 1) return;
        const double above = between(height(column, row), height(column + 1, row), part) - z;
        if (row < rows - 1) lower_left_[post(column, row)].add(above);
        if (row > 0) upper_right_[post(column, row - 1)].add(above);
        if (fails(above))
          note_failure(from, to, {{column, row}, {column + 1, row}, {column, row + 1}, {column + 1, row - 1}}, above);
      });
  // Diagonals, by the sum of column and row.
  cross_family(
      a.column + a.row, b.column + b.row, a.column, b.column, 1, columns + rows - 3, za, zb,
      [&](std::int64_t sum, std::int64_t column, double part, double z) {
        const std::int64_t row = sum - column - 1;
        if (column < 0 || column >= columns - 1 || row < 0 || row >= rows - 1) return;
        const double above = between(height(column, row + 1), height(column + 1, row), part) - z;
        lower_left_[post(column, row)].add(above);
        upper_right_[post(column, row)].add(above);
        if (fails(above))
          note_failure(from, to, {{column, row + 1}, {column + 1, row}, {column, row}, {column + 1, row + 1}}, above);
      });
}

void LatticeDifference::note_failure(std::uint32_t from, std::uint32_t to, const Side& side, double above) {
  if (is_left_out(side.u) || is_left_out(side.v)) return;  // so is their only triangle
  std::tie(from, to) = std::minmax({from, to});
  const Corner &p = corners_[from], &q = corners_[to];
  const auto code = [&](Place post) { return code_of(posts_.position(post)); };
  // Where both ends are as near it is the one with the lesser code, as in meshes.
  const auto distance = [&](Place v) {
    const std::int64_t area = (q.column - p.column) * (v.row - p.row) - (q.row - p.row) * (v.column - p.column);
    return std::pair(std::abs(area), code(v));
  };
  const auto [nearer, farther] = std::minmax({distance(side.u), distance(side.v)});
  const bool no_left = is_left_out(side.left), no_right = is_left_out(side.right);
  const auto [least, greatest] =
      std::minmax({code(no_left ? side.right : side.left), code(no_right ? side.left : side.right)});
  failures_.crossings.push_back({from,
                                 to,
                                 static_cast<std::int32_t>(std::ceil(std::abs(above) + kRounding)),
                                 {nearer.second, farther.second, least, greatest}});
}

/// Whether no triangle has this post. A corner of the lattice has one triangle, which may not meet the lattice's box.
bool LatticeDifference::is_left_out(Place post) const {
  const std::int64_t columns = posts_.columns(), rows = posts_.rows();
  return post.column < 0 || post.column >= columns || post.row < 0 || post.row >= rows ||
         (!posts_.first_triangle_meets() && post.column == 0 && post.row == 0) ||
         (!posts_.last_triangle_meets() && post.column == columns - 1 && post.row == rows - 1);
}

void LatticeDifference::leave_out_corners() {
  if (!posts_.first_triangle_meets()) at_post_.front() = kAbsent, lower_left_.front() = {};
  if (!posts_.last_triangle_meets()) {
    at_post_.back() = kAbsent;
    upper_right_[posts_.post(posts_.columns() - 2, posts_.rows() - 2)] = {};
  }
}

DifferenceRange LatticeDifference::over(const GridBox& box) const {
  const auto [west, east] = posts_.square_columns(box.xmin, box.xmax);
  const auto [south, north] = posts_.square_rows(box.ymin, box.ymax);
  if (west >= east || south >= north) return {};
  Range at_posts, at_crossings;
  for (std::int32_t row = south; row <= north; ++row)
    for (std::int32_t column = west; column <= east; ++column) at_posts.add(at_post_[posts_.post(column, row)]);
  for (std::int32_t row = south; row < north; ++row) {
    for (std::int32_t column = west; column < east; ++column) {
      for (const auto* const triangles : {&lower_left_, &upper_right_}) {
        const Range& range = (*triangles)[posts_.post(column, row)];
        at_crossings.lo = std::min(at_crossings.lo, range.lo), at_crossings.hi = std::max(at_crossings.hi, range.hi);
      }
    }
  }
  return {static_cast<std::int32_t>(std::floor(std::min(at_posts.lo, at_crossings.lo - kRounding))),
          static_cast<std::int32_t>(std::ceil(std::max(at_posts.hi, at_crossings.hi + kRounding)))};
}

}  // namespace itin
