// What bins tell of a sight line that crosses them one after the other. The line is certainly hidden where it runs
// below the least height of one bin, and certainly visible where it runs above the greatest heights of all.
//
//   const BinWalk walk(bins, request.earth.drop_coefficient() * resolution);
//   if (walk.along(eye.units, target) == Verdict::kHidden) ...
#pragma once

#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <viewshed/result.hpp>

#include "bounds/surface_bins.hpp"

namespace itin::viewshed {

class BinWalk {
 public:
  /// The bins must be complete, and outlive this object. `drop`: grid units per squared grid unit.
  BinWalk(const SurfaceBins& bins, double drop);

  /// Decides a line between ends in grid units; kUndecided where bins leave it open. What lies beside all bins hides
  /// nothing. Cost: one step per bin, or per block of 8 x 8 bins that the line passes above.
  Verdict along(const Point3& from, const Point3& to) const;

 private:
  struct Line;
  /// A part of a line, as fractions of its length.
  struct Stretch {
    double first, last;
  };

  const SurfaceBins& bins_;
  double drop_;
  std::int64_t block_columns_, block_rows_;
  std::vector<float> block_high_;  ///< the greatest height of each block of bins
};

}  // namespace itin::viewshed
