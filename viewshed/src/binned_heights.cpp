#include "binned_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/parallel.hpp>

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

float rounded_down(double v) {
  const auto near = static_cast<float>(v);
  return near <= v ? near : std::nextafter(near, -kInfinity);
}
float rounded_up(double v) {
  return -rounded_down(-v);
}

/// A square with some slack, grid units.
struct Square {
  double x = 0, y = 0;  ///< its middle
  double half = 0;
};

/// A triangle's heights about a square's middle.
class Facet {
 public:
  Facet(const Tin& tin, const Triangle& t, const Square& square) : half_(square.half) {
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint& v = tin.vertices[t[i]];
      corners_[i] = {v.x - square.x, v.y - square.y, static_cast<double>(v.z)};
    }
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

}  // namespace

BinnedHeights::BinnedHeights(const Tin& tin) : BinnedHeights(tin, cell_lattice(tin)) {}

BinnedHeights::BinnedHeights(const Tin& tin, const std::optional<CellLattice>& lattice)
    : units_(tin.grid),
      grid_(lattice ? lattice->grid : bin_grid(tin)),
      bins_(lattice ? TriangleBins(*lattice) : TriangleBins(tin, grid_)),
      tops_(tin.triangles.size()),
      lids_(grid_.cell_count()),
      lattice_(lattice.has_value()),
      boundary_(lattice_ ? boundary_edges(tin, *lattice) : boundary_edges(tin)) {
  std::transform(tin.triangles.begin(), tin.triangles.end(), tops_.begin(), [&](const Triangle& t) {
    return std::max({tin.vertices[t[0]].z, tin.vertices[t[1]].z, tin.vertices[t[2]].z});
  });
  for (const GridPoint& v : tin.vertices)
    greatest_magnitude_ = std::max(greatest_magnitude_, std::abs(static_cast<double>(v.z)));
  Ranges ranges{std::vector(grid_.cell_count(), -kInfinity), std::vector(grid_.cell_count(), -kInfinity)};
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t r) {
    for (std::int64_t c = 0; c < columns(); ++c) {
      const RasterGrid::Cell bin{c, static_cast<std::int64_t>(r)};
      lattice ? bound_cell(*lattice, bin, ranges) : bound(tin, bin, ranges);
    }
  });
  if (!lattice_) forget_depth_at_boundary(tin, ranges.low);
  bound_runs(ranges);
}

void BinnedHeights::bound(const Tin& tin, RasterGrid::Cell bin, Ranges& ranges) {
  const std::size_t number = grid_.index(bin);
  const auto listed = bins_.triangles(number);
  if (listed.empty()) return;
  const Point2 middle = grid_.centre(bin.column, bin.row);
  const Square square{(middle.x - units_.origin.x) / units_.resolution,
                      (middle.y - units_.origin.y) / units_.resolution, bin_size() * (0.5 + 2 * kSlack)};
  double low = kInfinity, high = -kInfinity, area = 0, rise_x = 0, rise_y = 0;
  for (const std::uint32_t t : listed) {
    const Facet facet(tin, tin.triangles[t], square);
    const auto [lowest, highest] = facet.range_above(0, 0);
    low = std::min(low, lowest), high = std::max(high, highest);
    area += facet.doubled_area(), rise_x += facet.rise_x(), rise_y += facet.rise_y();
  }
  ranges.low[number] = rounded_down(low), ranges.high[number] = rounded_up(high);
  // Sloping as the triangles do on average; rows count southwards.
  Lid& lid = lids_[number];
  const auto size = static_cast<float>(bin_size());
  lid.per_column = area > 0 ? static_cast<float>(rise_x / area) * size : 0;
  lid.per_row = area > 0 ? static_cast<float>(-rise_y / area) * size : 0;
  double above = -kInfinity;
  for (const std::uint32_t t : listed)
    above = std::max(above, Facet(tin, tin.triangles[t], square)
                                .range_above(lid.per_column / bin_size(), -lid.per_row / bin_size())
                                .second);
  lid.middle = rounded_up(above);
}

/// A lattice's cell: between its corners, if both of its triangles are there; of one triangle nothing is known where it
/// is not.
void BinnedHeights::bound_cell(const CellLattice& lattice, RasterGrid::Cell bin, Ranges& ranges) {
  const std::size_t number = grid_.index(bin), held = bins_.triangles(number).size();
  if (held == 0) return;
  const std::size_t below = number + static_cast<std::size_t>(columns());
  const std::array<double, 4> corners{double(lattice.posts[number]), double(lattice.posts[number + 1]),
                                      double(lattice.posts[below]), double(lattice.posts[below + 1])};
  const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
  ranges.high[number] = rounded_up(*greatest);
  Lid& lid = lids_[number];
  lid.middle = ranges.high[number];
  if (held < 2) return;
  ranges.low[number] = rounded_down(*least);
  lid.per_column = static_cast<float>((corners[1] - corners[0] + corners[3] - corners[2]) / 2);
  lid.per_row = static_cast<float>((corners[2] - corners[0] + corners[3] - corners[1]) / 2);
  const double east = double{lid.per_column} / 2, south = double{lid.per_row} / 2;
  lid.middle = rounded_up(std::max(
      {corners[0] + east + south, corners[1] - east + south, corners[2] + east - south, corners[3] - east - south}));
}

/// A bin that a triangle meets and no boundary crosses is covered throughout; elsewhere nothing is known of how low the
/// ground is.
void BinnedHeights::forget_depth_at_boundary(const Tin& tin, std::vector<float>& low) const {
  std::vector<bool> at_boundary(tin.triangles.size());
  for (const BoundaryEdge& edge : boundary_) at_boundary[edge.triangle] = true;
  parallel_for(grid_.cell_count() / kChunk + 1, [&](std::size_t chunk) {
    for (std::size_t bin = chunk * kChunk; bin < std::min((chunk + 1) * kChunk, low.size()); ++bin) {
      const auto listed = bins_.triangles(bin);
      if (std::any_of(listed.begin(), listed.end(), [&](std::uint32_t t) { return at_boundary[t]; }))
        low[bin] = -kInfinity;
    }
  });
}

void BinnedHeights::bound_runs(const Ranges& ranges) {
  const auto bound = [&](Runs& runs, std::int64_t lines, std::int64_t length, const auto& bin_at) {
    runs.a_line = (length + kRun - 1) / kRun;
    const auto count = static_cast<std::size_t>(lines * runs.a_line);
    runs.low.resize(count), runs.high.resize(count);
    const auto bound_run = [&](std::int64_t line, std::int64_t run) {
      float low = kInfinity, high = -kInfinity;
      for (std::int64_t i = run * kRun; i < std::min(length, (run + 1) * kRun); ++i) {
        const std::size_t bin = grid_.index(bin_at(line, i)),
                          beside = grid_.index(bin_at(std::min(line + 1, lines - 1), i));
        low = std::min({low, ranges.low[bin], ranges.low[beside]}), high = std::max(high, ranges.high[bin]);
      }
      const auto at = static_cast<std::size_t>(line * runs.a_line + run);
      runs.low[at] = low, runs.high[at] = high;
    };
    // In strips, so that columns of bins stay in the cache.
    constexpr std::int64_t kStrip = 16;
    parallel_for(static_cast<std::size_t>((lines + kStrip - 1) / kStrip), [&](std::size_t strip) {
      const std::int64_t first = static_cast<std::int64_t>(strip) * kStrip, last = std::min(lines, first + kStrip);
      for (std::int64_t run = 0; run < runs.a_line; ++run)
        for (std::int64_t line = first; line < last; ++line) bound_run(line, run);
    });
  };
  using Cell = RasterGrid::Cell;
  bound(eastwards_, rows(), columns(), [](std::int64_t line, std::int64_t i) { return Cell{i, line}; });
  bound(southwards_, columns(), rows(), [](std::int64_t line, std::int64_t i) { return Cell{line, i}; });
}

std::optional<double> BinnedHeights::ground(const Tin& tin, Point2 position) const {
  const Point2 units{easting_in_units(tin.grid, position.x), northing_in_units(tin.grid, position.y)};
  std::optional<double> height;
  find_at(units.x, units.y, [&](std::span<const std::uint32_t> triangles) {
    height = surface_height_at(tin, triangles, units);
    return height.has_value();
  });
  return height ? std::optional(*height * units_.resolution) : std::nullopt;
}

}  // namespace itin::viewshed
