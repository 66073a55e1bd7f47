// How low and how high a surface is within bins (bin_bounds.hpp), and which triangles meet each bin. A lattice's bins
// are its cells, and their bounds are told from the posts when they are asked for.
//
//   BinnedHeights bins(tin);
//   bins.upper_plane(bin).at(column, row)                            // grid units
//   bins.for_each_triangle(bin, [&](std::uint32_t t) { return use(bins.corners(t)); });
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <itin/lattice_tin.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/bin_bounds.hpp"
#include "bounds/boundary.hpp"
#include "bounds/triangle_bins.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

class BinnedHeights : public BinBounds {
 public:
  /// The surface must outlive this object. A bin has about two triangles, at 40 bytes per triangle, or fewer where
  /// cells of this area, square metres, are far smaller: many lines are decided by what is known of bins. A lattice's
  /// bins are its cells, and take a fraction of that.
  explicit BinnedHeights(const Tin& tin, double cell_area = kInfinity);
  explicit BinnedHeights(const LatticeTin& lattice);
  /// Takes in heights of these tiles of the lattice that have been read since: they count from now on.
  void add(std::span<const std::uint32_t> tiles);
  bool holds(RasterGrid::Cell bin) const { return bin.column < columns() && bin.row < rows(); }

  /// A plane that the surface within one bin does not rise above.
  struct UpperPlane {
    double middle = -kInfinity;
    double per_column = 0, per_row = 0;
    /// The height at a position `east` and `south` bins from the bin's middle; grid units.
    double at(double east, double south) const { return middle + per_column * east + per_row * south; }
  };
  /// Tells whether a lattice's bin has been read and has no post above a height, grid units: sooner than its upper
  /// plane does.
  bool lies_below(RasterGrid::Cell bin, double height) const {
    if (lattice_ == nullptr || !lattice_->read(cell(bin))) return false;
    const std::int32_t* const upper = lattice_->posts(cell(bin));
    const std::int32_t* const lower = upper + LatticeTin::kPosts;
    return std::max(std::max(upper[0], upper[1]), std::max(lower[0], lower[1])) <= height;
  }
  UpperPlane upper_plane(RasterGrid::Cell bin) const {
    if (lattice_ != nullptr) return upper_plane_of_cell(*lattice_, cell(bin));
    const auto& [middle, per_column, per_row] = listed_->upper_planes[grid_.index(bin)];
    return {middle, per_column, per_row};
  }
  /// Calls visit(triangle) for the triangles that meet the bin, or nearly meet it (up to kSlack bins away at least),
  /// and may rise above a height, grid units. Ends when one call returns false, and returns whether none did.
  template <class Visit>
  bool for_each_triangle(RasterGrid::Cell bin, double above, const Visit& visit) const {
    if (lattice_ != nullptr) return !lattice_->read(cell(bin)) || lattice_->for_each_triangle(cell(bin), visit);
    const auto listed = triangles(bin);
    return std::all_of(listed.begin(), listed.end(),
                       [&](std::uint32_t t) { return listed_->tops[t] <= above || visit(t); });
  }
  /// These triangles, ascending. Precondition: the surface is no lattice.
  std::span<const std::uint32_t> triangles(RasterGrid::Cell bin) const {
    return listed_->bins.triangles(grid_.index(bin));
  }
  static constexpr double kSlack = 1e-7;
  std::array<GridPoint, 3> corners(std::uint32_t triangle) const {
    return lattice_ != nullptr ? lattice_->corners(triangle) : tin_->corners(triangle);
  }
  /// The edges where the surface ends.
  const std::vector<RimEdge>& rim() const { return rim_; }
  /// Whether each triangle lies in one bin alone.
  bool partition() const { return lattice_ != nullptr; }
  /// The surface's height at a position, if it is there; grid units. kUnread where it has not been read.
  std::optional<double> height_at(Point2 units) const;
  /// What lies at all positions between two corners: no ground, ground of which none has been read, or something not
  /// told.
  enum class Expanse : std::uint8_t { kAllBare, kAllUnread, kVarious };
  Expanse expanse(Point2 north_west, Point2 south_east) const;

 private:
  BinnedHeights(const Tin& tin, std::optional<LatticeTin> lattice, double cell_area);

  using Range = RunBounds::Range<float>;
  /// These are computed once for a Tin that is no lattice.
  struct Listed {
    TriangleBins bins;
    std::vector<std::array<float, 3>> upper_planes;  ///< per bin: what UpperPlane has
    std::vector<std::int32_t> tops;                  ///< per triangle: its highest vertex
  };
  std::uint32_t cell(RasterGrid::Cell bin) const {
    return lattice_->cell(static_cast<std::uint32_t>(bin.column), static_cast<std::uint32_t>(bin.row));
  }
  static UpperPlane upper_plane_of_cell(const LatticeTin& lattice, std::uint32_t cell);
  void bound_lattice();
  void bound_tile(std::uint32_t tile);
  std::optional<double> height_amid_square(double column, double row, Point2 units) const;
  bool unread_at(RasterGrid::Cell bin, Point2 units) const;
  void bound_tin();
  class Facet;
  Range bound_bin(RasterGrid::Cell bin, const std::vector<bool>& at_boundary, std::vector<Facet>& facets);

  const Tin* tin_ = nullptr;
  std::optional<LatticeTin> own_;        ///< made of the Tin
  const LatticeTin* lattice_ = nullptr;  ///< else it is the Tin
  std::optional<Listed> listed_;
  std::vector<RimEdge> rim_;
};

/// Takes sums and halves of whole numbers, which are all exact.
inline BinnedHeights::UpperPlane BinnedHeights::upper_plane_of_cell(const LatticeTin& lattice, std::uint32_t cell) {
  if (!lattice.read(cell)) return {};
  const std::uint8_t there = lattice.halves(cell);
  if (there == 0) return {};
  const std::int32_t* const upper = lattice.posts(cell);
  const std::int32_t* const lower = upper + LatticeTin::kPosts;
  const double nw = upper[0], ne = upper[1], sw = lower[0], se = lower[1];
  if (!LatticeTin::whole(there)) return {std::max(std::max(nw, ne), std::max(sw, se)), 0, 0};
  const double per_column = (ne - nw + se - sw) / 2, per_row = (sw - nw + se - ne) / 2;
  // Both pairs of opposite corners are as far above the plane through the middle of all four.
  return {(nw + ne + sw + se) / 4 + std::abs(nw - ne - sw + se) / 4, per_column, per_row};
}

}  // namespace itin::viewshed
