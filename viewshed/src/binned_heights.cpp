#include "binned_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/parallel.hpp>

#include "rounded_outwards.hpp"
#include "surface_heights.hpp"

namespace itin::viewshed {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kChunk = 4096;

RasterGrid bin_grid(const Tin& tin) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double width = std::max(box.width(), tin.grid.resolution), height = std::max(box.height(), tin.grid.resolution);
  const double bin = std::sqrt(2 * width * height / static_cast<double>(tin.triangles.size()));
  // Half a bin more than needed all around, so that the edges lie inside.
  const auto count = [&](double length) { return static_cast<std::int64_t>(std::ceil(length / bin)) + 1; };
  return {{box.xmin - bin / 2, box.ymax + bin / 2}, bin, bin, count(width), count(height)};
}

/// A square with some slack, grid units.
struct Square {
  double x = 0, y = 0;  ///< its middle
  double half = 0;
};

/// A triangle's heights about a square's middle.
class Facet {
 public:
  Facet(const std::array<GridPoint, 3>& corners, const Square& square) : half_(square.half) {
    std::transform(corners.begin(), corners.end(), corners_.begin(), [&](const GridPoint& v) {
      return Point3{v.x - square.x, v.y - square.y, static_cast<double>(v.z)};
    });
    const auto& [a, b, c] = corners_;
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z, cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    doubled_area_ = bx * cy - by * cx;
    rise_x_ = bz * cy - by * cz, rise_y_ = bx * cz - bz * cx;
  }

  double doubled_area() const { return doubled_area_; }
  /// The slopes times the doubled area.
  double rise_x() const { return rise_x_; }
  double rise_y() const { return rise_y_; }

  /// Lowest and highest above a plane through the middle, over the square at most; low > high where the triangle only
  /// nearly meets it.
  std::pair<double, double> range_above(double plane_x, double plane_y) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point3& p : corners_) {
      const double above = p.z - plane_x * p.x - plane_y * p.y;
      low = std::min(low, above), high = std::max(high, above);
    }
    if (doubled_area_ == 0) return {low, high};
    const Point3& a = corners_[0];
    const double x = rise_x_ / doubled_area_ - plane_x, y = rise_y_ / doubled_area_ - plane_y;
    // The last term covers the rounding of what stands before it.
    const double spread =
        (std::abs(x) + std::abs(y)) * half_ + 1e-12 * (std::abs(x * a.x) + std::abs(y * a.y) + std::abs(high - low));
    const double middle = a.z - plane_x * a.x - plane_y * a.y - (x * a.x + y * a.y);
    return {std::max(low, middle - spread), std::min(high, middle + spread)};
  }

 private:
  std::array<Point3, 3> corners_;
  double half_, doubled_area_, rise_x_, rise_y_;
};

/// The cells of a lattice as bins.
RasterGrid bin_grid(const LatticeTin& lattice) {
  const Point2 corner = lattice.grid.position(lattice.west, lattice.north);
  const double side = lattice.spacing * lattice.grid.resolution;
  return {corner, side, side, lattice.columns, lattice.rows};
}

double greatest_magnitude_of(std::int32_t z, double greatest) {
  return std::max(greatest, std::abs(static_cast<double>(z)));
}

}  // namespace

BinnedHeights::BinnedHeights(const Tin& tin) : BinnedHeights(tin, lattice_of(tin)) {}

BinnedHeights::BinnedHeights(const Tin& tin, std::optional<LatticeTin> lattice)
    : tin_(&tin),
      own_(std::move(lattice)),
      lattice_(own_ ? &*own_ : nullptr),
      units_(tin.grid),
      grid_(own_ ? bin_grid(*own_) : bin_grid(tin)) {
  own_ ? bound_lattice() : bound_tin();
}

BinnedHeights::BinnedHeights(const LatticeTin& lattice)
    : lattice_(&lattice), units_(lattice.grid), grid_(bin_grid(lattice)) {
  bound_lattice();
}

void BinnedHeights::bound_lattice() {
  rim_ = lattice_->rim();
  for (const std::int32_t z : lattice_->heights)
    if (z != LatticeTin::kNoPost) greatest_magnitude_ = greatest_magnitude_of(z, greatest_magnitude_);
  bound_runs([&](std::size_t cell) { return range_of_cell(*lattice_, cell); });
}

void BinnedHeights::bound_tin() {
  const Tin& tin = *tin_;
  listed_.emplace(Listed{TriangleBins(tin, grid_), std::vector<Lid>(grid_.cell_count()), {}});
  for (std::uint32_t t = 0; t < tin.triangles.size(); ++t) {
    const auto [a, b, c] = tin.corners(t);
    listed_->tops.push_back(std::max({a.z, b.z, c.z}));
  }
  for (const GridPoint& v : tin.vertices) greatest_magnitude_ = greatest_magnitude_of(v.z, greatest_magnitude_);
  std::vector<Range> ranges(grid_.cell_count());
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t r) {
    for (std::int64_t c = 0; c < columns(); ++c) {
      const RasterGrid::Cell bin{c, static_cast<std::int64_t>(r)};
      ranges[grid_.index(bin)] = bound_bin(bin);
    }
  });
  const std::vector<BoundaryEdge> boundary = boundary_edges(tin);
  rim_ = rim_of(tin, boundary);
  forget_depth_at_boundary(boundary, ranges);
  bound_runs([&](std::size_t bin) { return ranges[bin]; });
}

BinnedHeights::Range BinnedHeights::bound_bin(RasterGrid::Cell bin) {
  const std::size_t number = grid_.index(bin);
  const auto listed = listed_->bins.triangles(number);
  if (listed.empty()) return {-kInfinity, -kInfinity};
  const Point2 middle = grid_.centre(bin.column, bin.row);
  const Square square{(middle.x - units_.origin.x) / units_.resolution,
                      (middle.y - units_.origin.y) / units_.resolution, bin_size() * (0.5 + 2 * kSlack)};
  double low = kInfinity, high = -kInfinity, area = 0, rise_x = 0, rise_y = 0;
  for (const std::uint32_t t : listed) {
    const Facet facet(tin_->corners(t), square);
    const auto [lowest, highest] = facet.range_above(0, 0);
    low = std::min(low, lowest), high = std::max(high, highest);
    area += facet.doubled_area(), rise_x += facet.rise_x(), rise_y += facet.rise_y();
  }
  // Sloping as the triangles do on average; rows count southwards.
  const double slope_x = area > 0 ? rise_x / area : 0, slope_y = area > 0 ? rise_y / area : 0;
  double above = -kInfinity;
  for (const std::uint32_t t : listed)
    above = std::max(above, Facet(tin_->corners(t), square).range_above(slope_x, slope_y).second);
  listed_->lids[number] = {above, slope_x * bin_size(), -slope_y * bin_size()};
  return {rounded_down(low), rounded_up(high)};
}

/// Of a cell with one triangle nothing is known where that is not.
BinnedHeights::Range BinnedHeights::range_of_cell(const LatticeTin& lattice, std::size_t cell) {
  if (lattice.halves[cell] == 0) return {-kInfinity, -kInfinity};
  const std::int32_t* const upper = lattice.heights.data() + cell;
  const std::int32_t* const lower = upper + lattice.columns;
  const float high = rounded_up(std::max(std::max(upper[0], upper[1]), std::max(lower[0], lower[1])));
  if (!lattice.whole(cell)) return {-kInfinity, high};
  return {rounded_down(std::min(std::min(upper[0], upper[1]), std::min(lower[0], lower[1]))), high};
}

/// Sums and halves of whole numbers, all exact.
BinnedHeights::Lid BinnedHeights::lid_of_cell(const LatticeTin& lattice, std::size_t cell) {
  if (lattice.halves[cell] == 0) return {};
  const std::int32_t* const upper = lattice.heights.data() + cell;
  const std::int32_t* const lower = upper + lattice.columns;
  const double nw = upper[0], ne = upper[1], sw = lower[0], se = lower[1];
  if (!lattice.whole(cell)) return {std::max(std::max(nw, ne), std::max(sw, se)), 0, 0};
  const double per_column = (ne - nw + se - sw) / 2, per_row = (sw - nw + se - ne) / 2;
  // Both pairs of opposite corners are as far above the plane through the middle of all four.
  return {(nw + ne + sw + se) / 4 + std::abs(nw - ne - sw + se) / 4, per_column, per_row};
}

/// A bin that a triangle meets and no boundary crosses is covered throughout; elsewhere nothing is known of how low the
/// ground is.
void BinnedHeights::forget_depth_at_boundary(const std::vector<BoundaryEdge>& boundary,
                                             std::vector<Range>& ranges) const {
  std::vector<bool> at_boundary(tin_->triangles.size());
  for (const BoundaryEdge& edge : boundary) at_boundary[edge.triangle] = true;
  parallel_for(ranges.size() / kChunk + 1, [&](std::size_t chunk) {
    for (std::size_t bin = chunk * kChunk; bin < std::min((chunk + 1) * kChunk, ranges.size()); ++bin) {
      const auto listed = listed_->bins.triangles(bin);
      if (std::any_of(listed.begin(), listed.end(), [&](std::uint32_t t) { return at_boundary[t]; }))
        ranges[bin].low = -kInfinity;
    }
  });
}

/// In blocks that stay in the cache, each with the bins beside it.
template <class RangeOf>
void BinnedHeights::bound_runs(const RangeOf& range_of) {
  const auto make = [](Runs& runs, std::int64_t lines, std::int64_t length) {
    runs.a_line = (length + kRun - 1) / kRun;
    runs.low.resize(static_cast<std::size_t>(lines * runs.a_line)), runs.high.resize(runs.low.size());
  };
  make(eastwards_, rows(), columns()), make(southwards_, columns(), rows());
  constexpr std::int64_t kBlockRows = 64, kBlockColumns = 256, kStride = kBlockColumns + 1;
  parallel_for(static_cast<std::size_t>((rows() + kBlockRows - 1) / kBlockRows), [&](std::size_t strip) {
    std::vector<Range> ranges(static_cast<std::size_t>((kBlockRows + 1) * kStride));
    const std::int64_t first_row = static_cast<std::int64_t>(strip) * kBlockRows,
                       end_row = std::min(rows(), first_row + kBlockRows), last_row = std::min(rows() - 1, end_row);
    for (std::int64_t first = 0; first < columns(); first += kBlockColumns) {
      const std::int64_t end = std::min(columns(), first + kBlockColumns), last = std::min(columns() - 1, end);
      const auto at = [&](std::int64_t row, std::int64_t column) -> Range& {
        return ranges[static_cast<std::size_t>((row - first_row) * kStride + column - first)];
      };
      for (std::int64_t row = first_row; row <= last_row; ++row)
        for (std::int64_t column = first; column <= last; ++column)
          at(row, column) = range_of(grid_.index({column, row}));
      const auto bound = [](Runs& runs, std::int64_t line, std::int64_t from, std::int64_t to, const auto& bin,
                            const auto& beside) {
        float low = kInfinity, high = -kInfinity;
        for (std::int64_t i = from; i < to; ++i)
          low = std::min(low, std::min(bin(i).low, beside(i).low)), high = std::max(high, bin(i).high);
        const auto place = static_cast<std::size_t>(line * runs.a_line + from / kRun);
        runs.low[place] = low, runs.high[place] = high;
      };
      for (std::int64_t row = first_row; row < end_row; ++row)
        for (std::int64_t from = first; from < end; from += kRun)
          bound(
              eastwards_, row, from, std::min(end, from + kRun), [&](std::int64_t i) { return at(row, i); },
              [&](std::int64_t i) { return at(std::min(row + 1, last_row), i); });
      for (std::int64_t column = first; column < end; ++column)
        for (std::int64_t from = first_row; from < end_row; from += kRun)
          bound(
              southwards_, column, from, std::min(end_row, from + kRun), [&](std::int64_t i) { return at(i, column); },
              [&](std::int64_t i) { return at(i, std::min(column + 1, last)); });
    }
  });
}

std::optional<double> BinnedHeights::height_at(Point2 units) const {
  if (lattice_ != nullptr)
    if (const auto post = lattice_->post_at(units.x, units.y)) return *post;
  const double column = column_at(units.x), row = row_at(units.y);
  const auto at = [](double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(count - 1)));
  };
  std::optional<double> height;
  // One bin, or up to four at its edges.
  for (std::int64_t r = at(row - kSlack, rows()); r <= at(row + kSlack, rows()); ++r)
    for (std::int64_t c = at(column - kSlack, columns()); c <= at(column + kSlack, columns()); ++c)
      if (!for_each_triangle({c, r}, -kInfinity, [&](std::uint32_t t) {
            height = height_over(corners(t), units);
            return !height;
          }))
        return height;
  return std::nullopt;
}

}  // namespace itin::viewshed
