#include "lines/link_sharing.hpp"

#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <itin/level_choice.hpp>
#include <itin/store.hpp>

namespace itin::profile {

namespace {

// Measured (benchmarks/README.md): microseconds per point that is triangulated, and by how many more per triangle that
// is retrieved than per one that is walked through.
constexpr double kPerPoint = 1.2, kPerTriangle = 0.7;
/// A random line crosses so many edges of a Delaunay triangulation per mean spacing of its points (64 / (3 pi^2)).
constexpr double kEdgesPerSpacing = 2.16;
/// Metres: the side of the squares in which ground counts as met, about that of a tile.
constexpr double kSquare = 2000;

}  // namespace

bool sharing_pays(const Store& store, const Detail& detail, const std::vector<Link>& links) {
  std::set<std::pair<std::int64_t, std::int64_t>> squares;
  double length = 0;
  const Box ground = store.metadata().grid.box(store.metadata().bounds);
  for (const Link& link : links) {
    const double dx = link.to.x - link.from.x, dy = link.to.y - link.from.y, own = std::hypot(dx, dy);
    if (!(own < ground.width() + ground.height())) continue;  // leaves the data, or is no line at all
    length += own;
    const int steps = static_cast<int>(2 * own / kSquare) + 1;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      squares.emplace(static_cast<std::int64_t>(std::floor((link.from.x + t * dx) / kSquare)),
                      static_cast<std::int64_t>(std::floor((link.from.y + t * dy) / kSquare)));
    }
  }
  const double area = ground.width() * ground.height();
  if (area == 0) return true;
  const auto points = static_cast<double>(store.points_about(level_within(store.metadata(), detail.finest()), ground));
  const double density = points / area;
  const double met = density * static_cast<double>(squares.size()) * kSquare * kSquare;
  return kPerPoint * met < kPerTriangle * kEdgesPerSpacing * std::sqrt(density) * length;
}

}  // namespace itin::profile
