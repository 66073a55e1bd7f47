#include "pyramid/difference/lattice_difference.hpp"

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
      if (n == kNoTriangle || t < n) compare_crossings(mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3]);
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

/// The difference times the doubled area is a whole number. So their quotient is exact where it is whole, and lies
/// between the right whole numbers elsewhere.
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

void LatticeDifference::compare_crossings(std::uint32_t from, std::uint32_t to) {
  const Corner &a = corners_[from], &b = corners_[to];
  const auto between = [](std::int64_t p, std::int64_t q, double part) {
    return static_cast<double>(p) + part * static_cast<double>(q - p);
  };
  const auto height_at = [&](Place post) { return height(post.column, post.row); };
  for_each_crossing({a.column, a.row}, {b.column, b.row}, posts_.columns(), posts_.rows(),
                    [&](const LatticeSide& side, double part, double along) {
                      const double above =
                          between(height_at(side.u), height_at(side.v), part) - between(a.z, b.z, along);
                      if (is_square(side.lower_left))
                        lower_left_[post(side.lower_left.column, side.lower_left.row)].add(above);
                      if (is_square(side.upper_right))
                        upper_right_[post(side.upper_right.column, side.upper_right.row)].add(above);
                      if (std::abs(above) + kRounding > allowed_) note_failure(from, to, side, above);
                    });
}

bool LatticeDifference::is_square(Place lower_left) const {
  return lower_left.column >= 0 && lower_left.column < posts_.columns() - 1 && lower_left.row >= 0 &&
         lower_left.row < posts_.rows() - 1;
}

void LatticeDifference::note_failure(std::uint32_t from, std::uint32_t to, const LatticeSide& side, double above) {
  if (is_left_out(side.u) || is_left_out(side.v)) return;  // their only triangle is left out, too
  std::tie(from, to) = std::minmax({from, to});
  const Corner &p = corners_[from], &q = corners_[to];
  const auto code = [&](Place post) { return code_of(posts_.position(post)); };
  // Where both ends are equally near, the one with the lesser code counts, as in meshes.
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
