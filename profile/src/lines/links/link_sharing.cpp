#include "lines/links/link_sharing.hpp"

#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <itin/level_choice.hpp>
#include <itin/store.hpp>

namespace itin::profile {

namespace {

/// Costs in microseconds, as measured (benchmarks/HISTORY.md).
struct Costs {
  double shared_point;  ///< to read one point for all links
  double triangle;      ///< how much longer retrieving a triangle takes than walking through a shared one
};
constexpr Costs kTriangulated{1.2, 0.7}, kLattice{0.06, 0.33};
/// The number of links whose ground is looked at.
constexpr std::size_t kSamples = 16;
/// A random line crosses this many edges of a Delaunay triangulation per mean spacing of its points (64 / (3 pi^2)).
constexpr double kEdgesPerSpacing = 2.16;
/// The side, in metres, of the squares in which ground counts as met, about that of a tile.
constexpr double kSquare = 2000;

/// The work that all links take, one way or the other.
struct Work {
  double points = 0;     ///< about the links, each counted once
  double triangles = 0;  ///< crossed by the links
};

Work work_of(const Store& store, const Detail& detail, const std::vector<Link>& links, const Box& ground) {
  std::set<std::pair<std::int64_t, std::int64_t>> squares;
  double length = 0;
  for (const Link& link : links) {
    const double dx = link.to.x - link.from.x, dy = link.to.y - link.from.y, own = std::hypot(dx, dy);
    if (!(own < ground.width() + ground.height())) continue;  // it leaves the data, or is no line at all
    length += own;
    const int steps = static_cast<int>(2 * own / kSquare) + 1;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      squares.emplace(static_cast<std::int64_t>(std::floor((link.from.x + t * dx) / kSquare)),
                      static_cast<std::int64_t>(std::floor((link.from.y + t * dy) / kSquare)));
    }
  }
  const auto points = static_cast<double>(store.points_about(level_within(store.metadata(), detail.finest()), ground));
  const double density = points / (ground.width() * ground.height());
  return {density * static_cast<double>(squares.size()) * kSquare * kSquare,
          kEdgesPerSpacing * std::sqrt(density) * length};
}

bool pays(const Work& work, const Costs& costs) {
  return costs.shared_point * work.points < costs.triangle * work.triangles;
}

/// Whether most of the links, by a sample of them, lie on posts.
bool lie_on_lattices(const std::vector<Link>& links, const SectionSurface& surface) {
  const std::size_t step = links.size() / kSamples + 1;
  std::size_t asked = 0, lattices = 0;
  for (std::size_t i = 0; i < links.size(); i += step, ++asked) {
    const Point2 middle{(links[i].from.x + links[i].to.x) / 2, (links[i].from.y + links[i].to.y) / 2};
    if (surface.is_lattice_at(middle)) ++lattices;
  }
  return 2 * lattices > asked;
}

}  // namespace

bool sharing_pays(const Store& store, const Detail& detail, const std::vector<Link>& links,
                  const SectionSurface& surface) {
  const Box ground = store.metadata().grid.box(store.metadata().bounds);
  if (ground.width() * ground.height() == 0) return true;
  const Work work = work_of(store, detail, links, ground);
  return pays(work, kTriangulated) || (pays(work, kLattice) && lie_on_lattices(links, surface));
}

}  // namespace itin::profile
