#include "triangulate/selection.hpp"

#include <algorithm>
#include <cmath>

namespace itin {

namespace {

__extension__ typedef __int128 Int128;

// Far beyond every grid, yet squares and their sums still fit in 128 bits.
constexpr double kFarthest = 0x1p60;

std::int64_t rounded(double grid_units) {
  return std::llround(std::clamp(grid_units, -kFarthest, kFarthest));
}

int level_of(double tolerance, const std::vector<double>& tolerances) {
  const auto above = std::upper_bound(tolerances.begin() + 1, tolerances.end(), tolerance);
  return static_cast<int>(above - tolerances.begin()) - 1;
}

}  // namespace

Selection::Selection(const Detail& detail, const std::vector<double>& tolerances, const Grid& grid)
    : finest_(level_of(detail.finest(), tolerances)),
      coarsest_(level_of(detail.coarsest(), tolerances)),
      x_(rounded((detail.centre().x - grid.origin.x) / grid.resolution)),
      y_(rounded((detail.centre().y - grid.origin.y) / grid.resolution)) {
  for (std::size_t i = 0; i + 1 < detail.rings().size(); ++i) {
    const Ring& ring = detail.rings()[i];
    discs_.push_back({rounded(ring.radius / grid.resolution), level_of(ring.tolerance, tolerances)});
  }
}

int Selection::level_at(std::int64_t x, std::int64_t y) const {
  const Int128 dx = Int128{x} - x_, dy = Int128{y} - y_;
  const Int128 squared = dx * dx + dy * dy;
  for (const Disc& disc : discs_) {
    if (squared <= Int128{disc.radius} * disc.radius) return disc.level;
  }
  return coarsest_;
}

int Selection::finest_in(const GridBox& box) const {
  // Levels never fall with the distance from the centre, so the box's nearest position has the least.
  return level_at(std::clamp<std::int64_t>(x_, box.xmin, box.xmax), std::clamp<std::int64_t>(y_, box.ymin, box.ymax));
}

}  // namespace itin
