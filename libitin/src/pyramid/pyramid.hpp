// The Delaunay pyramid: from sorted points to a written store.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "import/sorted_points.hpp"
#include "store/store_writer.hpp"

namespace itin {

struct PyramidReport {
  std::uint64_t replaced = 0;  ///< coarser points that made room
  std::uint64_t isolated = 0;  ///< points left out: no ground about them
  std::vector<std::uint64_t> vertices_of_source;
};

/// Finds the coverage, gives every point its level, certifies the levels and writes it all. `sources` gives the gap
/// bases. Out of core: memory follows the leaves (about 100 bytes for 512 points) and the tiles in work, not the
/// points. The result depends on the set of points and the gap bases alone. Throws FileError, Cancelled.
PyramidReport build_pyramid(SortedPoints& points, const std::vector<SourceInfo>& sources, const Grid& grid,
                            const std::vector<double>& tolerances, StoreWriter& writer, Progress& progress);

}  // namespace itin
