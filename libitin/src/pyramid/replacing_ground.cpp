#include "pyramid/replacing_ground.hpp"

#include <cmath>

#include "pyramid/coverage/coverage.hpp"
#include "pyramid/levels/proposal.hpp"
#include "pyramid/points/working_index.hpp"
#include "store/store_writer.hpp"

namespace itin {

namespace {

std::vector<GridEdge> outline_of(SortedPoints points, const std::vector<SourceInfo>& sources, const Grid& grid,
                                 Progress& progress) {
  const WorkingIndex index(points, 1, kLeafCapacity);
  const Proposal ground = find_ground(index, index.work_cells(), gap_bases_of(sources, grid), nullptr, progress);
  std::vector<GridEdge> edges;
  for (const Segment& s : join_collinear(ground.outline)) edges.emplace_back(s.a(), s.b());
  return edges;
}

Point2 plan_of(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

/// The point of the line from a to b at this place on it.
GridPoint point_at(const GridPoint& a, const GridPoint& b, const Point2& place) {
  const double dx = double{1} * b.x - a.x, dy = double{1} * b.y - a.y;
  const double t = ((place.x - a.x) * dx + (place.y - a.y) * dy) / (dx * dx + dy * dy);
  const auto rounded = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  return {rounded(place.x), rounded(place.y), rounded(a.z + t * (double{1} * b.z - a.z))};
}

}  // namespace

ReplacingGround::ReplacingGround(SortedPoints points, const std::vector<SourceInfo>& sources, const Grid& grid,
                                 Progress& progress)
    : area_(outline_of(std::move(points), sources, grid, progress)) {}

std::vector<ReplacingGround::Piece> ReplacingGround::outside(const GridPoint& a, const GridPoint& b) const {
  std::vector<Piece> pieces;
  GridPoint from = a;
  const auto add_up_to = [&](const GridPoint& to) {
    if (from.x != to.x || from.y != to.y) pieces.emplace_back(from, to);
  };
  for (const auto& [entry, exit] : area_.inside_parts(plan_of(a), plan_of(b))) {
    add_up_to(point_at(a, b, entry));
    from = point_at(a, b, exit);
  }
  add_up_to(b);
  return pieces;
}

}  // namespace itin
