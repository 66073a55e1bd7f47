#include "lines/paths/foliage_on_path.hpp"

namespace itin::profile {

namespace {

/// The stretches between points, within which the leaf area is that of one feature.
struct PathPieces {
  std::vector<FoliageStretch> stretches;
  std::vector<Point2> middles;

  void add(const ProfilePoint& a, const ProfilePoint& b, std::uint16_t theme) {
    if (a.distance_m == b.distance_m) return;
    stretches.push_back({a.distance_m, b.distance_m, b.distance_m - a.distance_m, theme});
    middles.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2});
  }
};

}  // namespace

PathFoliage foliage_on_path(const Profile& surface, const LeafAreas& leaves) {
  PathFoliage foliage;
  PathPieces pieces;
  for (const FeatureRun& run : feature_runs(surface)) {
    if (run.theme >= leaves.vegetation().size() || !leaves.vegetation()[run.theme]) continue;
    const double from = surface.points[run.first].distance_m, to = surface.points[run.last].distance_m;
    if (from == to) continue;
    foliage.stretches.push_back({from, to, to - from, run.theme});
    foliage.length_m += to - from;
    for (std::size_t i = run.first; i < run.last; ++i) pieces.add(surface.points[i], surface.points[i + 1], run.theme);
  }
  foliage.transmittance = leaves.transmittance(pieces.stretches, leaves.at(pieces.stretches, pieces.middles));
  return foliage;
}

}  // namespace itin::profile
