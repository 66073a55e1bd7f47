#include "bounds/binned_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/lattice_tin.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

#include "bounds/surface_heights.hpp"
#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kTopsPerChunk = 4096;

/// A bin for every kTrianglesPerBin triangles. Where cells are far smaller, a bin for every kCellsPerBin cells, but no
/// more than kBinsPerTriangle per triangle, and no more than kMostFineBins in all, which take only a moment.
double bin_count(double triangles, double cells) {
  constexpr double kTrianglesPerBin = 2, kCellsPerBin = 16, kBinsPerTriangle = 64, kMostFineBins = 1 << 19;
  return std::max(triangles / kTrianglesPerBin,
                  std::min({cells / kCellsPerBin, triangles * kBinsPerTriangle, kMostFineBins}));
}

RasterGrid bins_over_tin(const Tin& tin, double cell_area) {
  const Box box = tin.bounds();
  if (box.empty()) return {{0, 0}, 1, 1, 1, 1};
  const double width = std::max(box.width(), tin.grid.resolution), height = std::max(box.height(), tin.grid.resolution);
  const double area = width * height;
  const double bin = std::sqrt(area / bin_count(static_cast<double>(tin.triangles.size()), area / cell_area));
  return bins_over({box.xmin, box.ymax}, width, height, bin);
}

/// A square with some slack, grid units.
struct Square {
  double x = 0, y = 0;  ///< its middle
  double half = 0;
};

/// The cells of a lattice as bins.
RasterGrid bins_over_lattice(const LatticeTin& lattice) {
  const Point2 corner = lattice.grid.position(lattice.west, lattice.north);
  const double side = lattice.spacing * lattice.grid.resolution;
  return {corner, side, side, lattice.columns, lattice.rows};
}

double greatest_magnitude_of(std::int32_t z, double greatest) {
  return std::max(greatest, std::abs(static_cast<double>(z)));
}

}  // namespace

/// A triangle's heights about a square's middle.
class BinnedHeights::Facet {
 public:
  Facet(const std::array<GridPoint, 3>& corners, const Square& square) : half_(square.half) {
    std::transform(corners.begin(), corners.end(), corners_.begin(), [&](const GridPoint& v) {
      return Point3{v.x - square.x, v.y - square.y, static_cast<double>(v.z)};
    });
    const auto& [a, b, c] = corners_;
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z, cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    doubled_area_ = bx * cy - by * cx;
    rise_x_ = bz * cy - by * cz, rise_y_ = bx * cz - bz * cx;
    if (doubled_area_ != 0) slope_x_ = rise_x_ / doubled_area_, slope_y_ = rise_y_ / doubled_area_;
  }

  double doubled_area() const { return doubled_area_; }
  /// The slopes times the doubled area.
  double rise_x() const { return rise_x_; }
  double rise_y() const { return rise_y_; }

  struct Range {
    double low, high;  ///< low > high where the triangle only nearly meets the square
  };
  /// Bounds of the triangle's heights above a plane through the middle, within the square.
  Range range_above(double plane_x, double plane_y) const {
    const auto above = [&](const Point3& p) { return p.z - plane_x * p.x - plane_y * p.y; };
    const double a = above(corners_[0]), b = above(corners_[1]), c = above(corners_[2]);
    const double low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
    if (doubled_area_ == 0) return {low, high};
    const double x = slope_x_ - plane_x, y = slope_y_ - plane_y;
    const double to_east = x * corners_[0].x, to_north = y * corners_[0].y;
    // The last term covers the rounding of what stands before it.
    const double spread =
        (std::abs(x) + std::abs(y)) * half_ + 1e-12 * (std::abs(to_east) + std::abs(to_north) + std::abs(high - low));
    const double middle = a - (to_east + to_north);
    return {std::max(low, middle - spread), std::min(high, middle + spread)};
  }

 private:
  std::array<Point3, 3> corners_;
  double half_, doubled_area_, rise_x_, rise_y_, slope_x_ = 0, slope_y_ = 0;
};

BinnedHeights::BinnedHeights(const Tin& tin, double cell_area) : BinnedHeights(tin, lattice_of(tin), cell_area) {}

BinnedHeights::BinnedHeights(const Tin& tin, std::optional<LatticeTin> lattice, double cell_area)
    : BinBounds(tin.grid, lattice ? bins_over_lattice(*lattice) : bins_over_tin(tin, cell_area)),
      tin_(&tin),
      own_(std::move(lattice)),
      lattice_(own_ ? &*own_ : nullptr) {
  own_ ? bound_lattice() : bound_tin();
}

BinnedHeights::BinnedHeights(const LatticeTin& lattice)
    : BinBounds(lattice.grid, bins_over_lattice(lattice)), lattice_(&lattice) {
  bound_lattice();
}

void BinnedHeights::bound_lattice() {
  rim_ = lattice_->rim();
  greatest_magnitude_ = std::max(std::abs(double{1} * lattice_->lowest), std::abs(double{1} * lattice_->highest));
  parallel_for(lattice_->tiles.size(), [&](std::size_t tile) {
    if (lattice_->tiles[tile].heights) bound_tile(static_cast<std::uint32_t>(tile));
  });
}

void BinnedHeights::add(std::span<const std::uint32_t> tiles) {
  // Runs at the ends of the tiles to the west and to the north have their neighbours in these tiles.
  std::vector<std::uint32_t> touched;
  const std::uint32_t columns = lattice_->tile_columns();
  for (const std::uint32_t tile : tiles) {
    touched.push_back(tile);
    if (tile % columns > 0) touched.push_back(tile - 1);
    if (tile >= columns) touched.push_back(tile - columns);
  }
  sort_unique(touched);
  parallel_for(touched.size(), [&](std::size_t i) {
    if (lattice_->tiles[touched[i]].heights) bound_tile(touched[i]);
  });
}

// The tiles of both thus have the same numbers.
static_assert(RunBounds::kSide == LatticeTin::kSide);

/// Nothing is known outside the triangle in a cell that has only one.
void BinnedHeights::bound_tile(std::uint32_t tile) {
  constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::lowest();
  using HeightRange = RunBounds::Range<std::int32_t>;
  const LatticeTin& lattice = *lattice_;
  const auto range_of_square = [](const std::int32_t* upper, bool whole) {
    const std::int32_t* const lower = upper + LatticeTin::kPosts;
    const std::int32_t high = std::max(std::max(upper[0], upper[1]), std::max(lower[0], lower[1]));
    if (!whole) return HeightRange{kNone, high};
    return HeightRange{std::min(std::min(upper[0], upper[1]), std::min(lower[0], lower[1])), high};
  };
  const std::uint32_t first = tile * LatticeTin::kCells;
  const std::int64_t first_column = lattice.column_of(first), first_row = lattice.row_of(first);
  const bool all_whole = lattice.tiles[tile].ground == LatticeTin::Ground::kWhole;
  const auto range_of = [&](std::int64_t column, std::int64_t row) {
    const std::int64_t c = column - first_column, r = row - first_row;
    if (all_whole && c < RunBounds::kSide && r < RunBounds::kSide)
      return range_of_square(lattice.tiles[tile].heights->data() + r * LatticeTin::kPosts + c, true);
    const std::uint32_t cell = this->cell({column, row});
    const std::uint8_t there = lattice.read(cell) ? lattice.halves(cell) : std::uint8_t{0};
    return there == 0 ? HeightRange{kNone, kNone} : range_of_square(lattice.posts(cell), LatticeTin::whole(there));
  };
  const auto low = [](std::int32_t z) { return z == kNone ? -kFloatInfinity : rounded_down(z); };
  const auto high = [](std::int32_t z) { return z == kNone ? -kFloatInfinity : rounded_up(z); };
  runs_.bound<std::int32_t>(tile, range_of, low, high);
}

void BinnedHeights::bound_tin() {
  const Tin& tin = *tin_;
  // This comes first, while the bins take no memory yet.
  const std::vector<BoundaryEdge> boundary = boundary_edges(tin);
  rim_ = rim_of(tin, boundary);
  std::vector<bool> at_boundary(tin.triangles.size());
  for (const BoundaryEdge& edge : boundary) at_boundary[edge.triangle] = true;
  for (const GridPoint& v : tin.vertices) greatest_magnitude_ = greatest_magnitude_of(v.z, greatest_magnitude_);
  listed_.emplace(Listed{TriangleBins(tin, grid_), {}, {}});
  listed_->tops.resize(tin.triangles.size());
  parallel_for(tin.triangles.size() / kTopsPerChunk + 1, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * kTopsPerChunk, tin.triangles.size());
    for (std::size_t t = chunk * kTopsPerChunk; t < end; ++t) {
      const auto [a, b, c] = tin.corners(static_cast<std::uint32_t>(t));
      listed_->tops[t] = std::max({a.z, b.z, c.z});
    }
  });
  listed_->upper_planes.resize(grid_.cell_count(), {-kFloatInfinity, 0, 0});
  std::vector<Range> ranges(grid_.cell_count());
  parallel_for(static_cast<std::size_t>(rows()), [&](std::size_t r) {
    std::vector<Facet> facets;
    for (std::int64_t c = 0; c < columns(); ++c) {
      const RasterGrid::Cell bin{c, static_cast<std::int64_t>(r)};
      ranges[grid_.index(bin)] = bound_bin(bin, at_boundary, facets);
    }
  });
  const auto range_of = [&](std::int64_t column, std::int64_t row) { return ranges[grid_.index({column, row})]; };
  const auto same = [](float z) { return z; };
  parallel_for(runs_.tile_count(), [&](std::size_t tile) { runs_.bound<float>(tile, range_of, same, same); });
}

/// A bin that a triangle meets and no boundary crosses is covered throughout; elsewhere nothing is known of how low the
/// ground is. `facets` is working memory.
BinnedHeights::Range BinnedHeights::bound_bin(RasterGrid::Cell bin, const std::vector<bool>& at_boundary,
                                              std::vector<Facet>& facets) {
  const std::size_t number = grid_.index(bin);
  const auto listed = listed_->bins.triangles(number);
  if (listed.empty()) return {-kFloatInfinity, -kFloatInfinity};
  const Point2 middle = grid_.centre(bin.column, bin.row);
  const Square square{(middle.x - units_.origin.x) / units_.resolution,
                      (middle.y - units_.origin.y) / units_.resolution, bin_size() * (0.5 + 2 * kSlack)};
  double low = kFloatInfinity, high = -kFloatInfinity, area = 0, rise_x = 0, rise_y = 0;
  bool covered = true;
  facets.clear();
  for (const std::uint32_t t : listed) {
    const Facet& facet = facets.emplace_back(tin_->corners(t), square);
    const Facet::Range range = facet.range_above(0, 0);
    low = std::min(low, range.low), high = std::max(high, range.high);
    area += facet.doubled_area(), rise_x += facet.rise_x(), rise_y += facet.rise_y();
    covered = covered && !at_boundary[t];
  }
  // The plane slopes as the triangles do on average; rows count southwards.
  const auto per_column = static_cast<float>(area > 0 ? rise_x / area * bin_size() : 0),
             per_row = static_cast<float>(area > 0 ? -rise_y / area * bin_size() : 0);
  const double slope_x = per_column / bin_size(), slope_y = -per_row / bin_size();
  double above = -kFloatInfinity;
  for (const Facet& facet : facets) above = std::max(above, facet.range_above(slope_x, slope_y).high);
  listed_->upper_planes[number] = {rounded_up(above), per_column, per_row};
  return {covered ? rounded_down(low) : -kFloatInfinity, rounded_up(high)};
}

std::optional<double> BinnedHeights::height_at(Point2 units) const {
  if (lattice_ != nullptr)
    if (const auto post = lattice_->post_at(units.x, units.y)) return *post;
  const double column = column_at(units.x), row = row_at(units.y);
  if (const auto height = height_amid_square(column, row, units)) return height;
  const auto at = [](double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(count - 1)));
  };
  std::optional<double> height;
  // The position lies in one bin, or in up to four at its edges.
  for (std::int64_t r = at(row - kSlack, rows()); r <= at(row + kSlack, rows()); ++r) {
    for (std::int64_t c = at(column - kSlack, columns()); c <= at(column + kSlack, columns()); ++c) {
      if (lattice_ != nullptr && !lattice_->read(cell({c, r}))) {
        if (unread_at({c, r}, units)) return kUnread;
      } else if (!for_each_triangle({c, r}, -kFloatInfinity, [&](std::uint32_t t) {
                   height = height_over(corners(t), units);
                   return !height;
                 })) {
        return height;
      }
    }
  }
  return std::nullopt;
}

/// The height where the surface is a lattice, and the position lies within a whole square that has been read, but not
/// on its sides; nothing elsewhere.
std::optional<double> BinnedHeights::height_amid_square(double column, double row, Point2 units) const {
  if (lattice_ == nullptr || !(column > 0 && row > 0)) return std::nullopt;
  const auto c = static_cast<std::int64_t>(column), r = static_cast<std::int64_t>(row);
  const auto amid = [](double v, std::int64_t n) {
    const double part = v - static_cast<double>(n);
    return part > kSlack && part < 1 - kSlack;
  };
  if (c >= columns() || r >= rows() || !amid(column, c) || !amid(row, r)) return std::nullopt;
  const std::uint32_t number = cell({c, r});
  if (!lattice_->read(number) || lattice_->halves(number) != LatticeTin::kFalling) return std::nullopt;
  const std::int32_t* const upper = lattice_->posts(number);
  const std::int32_t* const lower = upper + LatticeTin::kPosts;
  return height_over(
      FallingSquare{lattice_->x(static_cast<std::uint32_t>(c)), lattice_->y(static_cast<std::uint32_t>(r + 1)),
                    lattice_->spacing, lower[0], lower[1], upper[0], upper[1]},
      units);
}

BinnedHeights::Expanse BinnedHeights::expanse(Point2 north_west, Point2 south_east) const {
  if (lattice_ == nullptr) return Expanse::kVarious;
  const auto tile_at = [](double bin, std::int64_t bins) {
    return static_cast<std::uint32_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1))) / LatticeTin::kSide;
  };
  const double west = column_at(north_west.x), north = row_at(north_west.y), east = column_at(south_east.x),
               south = row_at(south_east.y);
  bool bare = true,
       unread = west >= 0 && north >= 0 && east < static_cast<double>(columns()) && south < static_cast<double>(rows());
  // A position on a tile's side also belongs to the tile beyond.
  for (std::uint32_t row = tile_at(north - kSlack, rows()); row <= tile_at(south + kSlack, rows()); ++row) {
    for (std::uint32_t column = tile_at(west - kSlack, columns()); column <= tile_at(east + kSlack, columns());
         ++column) {
      const LatticeTin::Tile& tile = lattice_->tiles[row * lattice_->tile_columns() + column];
      bare = bare && tile.ground == LatticeTin::Ground::kNone;
      unread = unread && tile.ground == LatticeTin::Ground::kWhole && !tile.heights;
      if (!bare && !unread) return Expanse::kVarious;
    }
  }
  return bare ? Expanse::kAllBare : Expanse::kAllUnread;
}

/// Tells whether a bin that has not been read has ground at a position.
bool BinnedHeights::unread_at(RasterGrid::Cell bin, Point2 units) const {
  const std::uint32_t number = cell(bin);
  if (lattice_->tiles[number / LatticeTin::kCells].ground == LatticeTin::Ground::kWhole) return true;
  return !lattice_->for_each_triangle(number,
                                      [&](std::uint32_t t) { return !height_over(lattice_->outline(t), units); });
}

}  // namespace itin::viewshed
