// Whether a Tin is a raster's: every triangle half a cell of one square lattice. Its cells are then the best of bins,
// for each holds two triangles as a whole, and none lies in two.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "boundary.hpp"

namespace itin::viewshed {

struct CellLattice {
  RasterGrid grid;  ///< metres; a cell more than needed on every side
  /// Of each triangle: its cell's number in the grid.
  std::vector<std::uint32_t> cell_of;
  /// Heights, grid units, of every cell's north-western corner; kNoPost where no vertex is.
  std::vector<std::int32_t> posts;
  static constexpr std::int32_t kNoPost = std::numeric_limits<std::int32_t>::min();
};

/// Nothing where the Tin is no lattice, or covers so little of one that a grid would be mostly empty. O(n); what is no
/// lattice is most often found out by the first few triangles.
std::optional<CellLattice> cell_lattice(const Tin& tin);

/// As boundary_edges(), for a fraction of the work. `lattice` is the Tin's.
std::vector<BoundaryEdge> boundary_edges(const Tin& tin, const CellLattice& lattice);

}  // namespace itin::viewshed
