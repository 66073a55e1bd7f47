#include "features/mesh/roof.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "features/plan/planar.hpp"
#include "features/plan/planarity.hpp"
#include "features/plan/polygon_sides.hpp"

namespace itin {

namespace {

GridPoint rounded(Point2 p, double z) {
  return {static_cast<std::int32_t>(std::llround(p.x)), static_cast<std::int32_t>(std::llround(p.y)),
          static_cast<std::int32_t>(std::llround(z))};
}

/// Distance from the eaves, in plan, of a roof that rises from a rectangle's long sides, or from all four.
struct RectangleRise {
  Rectangle rectangle;
  bool hipped;

  double at(Point2 p) const {
    const double x = p.x - rectangle.centre.x, y = p.y - rectangle.centre.y;
    const double along = x * rectangle.axis.x + y * rectangle.axis.y;
    const double across = y * rectangle.axis.x - x * rectangle.axis.y;
    const double side = rectangle.half_width - std::abs(across);
    const double rise = hipped ? std::min(side, rectangle.half_length - std::abs(along)) : side;
    return std::max(0.0, rise);
  }
  Point2 position(double along, double across) const {
    const Point2 &centre = rectangle.centre, &u = rectangle.axis;
    return {centre.x + along * u.x - across * u.y, centre.y + along * u.y + across * u.x};
  }
  std::vector<std::pair<Point2, Point2>> creases() const {
    const double length = rectangle.half_length, width = rectangle.half_width;
    const double end = hipped ? length - width : length + 1;
    std::vector<std::pair<Point2, Point2>> lines;
    if (end > 0) lines.emplace_back(position(-end, 0), position(end, 0));
    if (!hipped) return lines;
    // Hips go a step beyond the corners, so that they reach a ring that was rounded.
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0})
        lines.emplace_back(position(s * end, 0), position(s * (length + 1), t * (width + 1)));
    return lines;
  }
};

/// The piecewise linear height of a roof by its distance from the eaves.
struct Pitch {
  double eaves, slope;
  double at(double rise) const { return eaves + slope * rise; }
};

Pitch pitch_of(const RoofHeights& heights, double run) {
  if (run <= 0) return {heights.eaves.value_or(heights.ridge.value_or(0)), 0};
  if (heights.eaves && heights.ridge) return {*heights.eaves, std::max(0.0, *heights.ridge - *heights.eaves) / run};
  if (heights.eaves) return {*heights.eaves, heights.slope};
  const double rise = std::clamp((*heights.ridge - heights.base) / 2, 0.0, heights.slope * run);
  return {*heights.ridge - rise, rise / run};
}

double flat_height(const RoofHeights& heights) {
  return heights.ridge ? *heights.ridge : *heights.eaves;
}

using HeightAt = std::function<double(Point2)>;

void add_rings(const GridPolygon& plan, const HeightAt& height, std::vector<RoofLine>& lines) {
  const auto point = [&](Position p) {
    const Point2 q{1.0 * p.x, 1.0 * p.y};
    return rounded(q, height(q));
  };
  for_each_edge(plan, [&](Position a, Position b) { lines.push_back({point(a), point(b), true}); });
}

void add_crease(const PolygonSides& plan, Point2 p, Point2 q, const HeightAt& height, std::vector<RoofLine>& lines) {
  for (const auto& [from, to] : plan.inside_parts(p, q))
    lines.push_back({rounded(from, height(from)), rounded(to, height(to)), false});
}

/// Creases end on rings and on each other where rounding put them: snap rounding makes that one graph.
std::vector<RoofLine> made_planar(const std::vector<RoofLine>& lines) {
  constexpr std::uint32_t kCrease = 0,
                          kEaves = 1;  // a crease knows its height where it meets the ring between vertices
  std::vector<OwnedSegment> segments;
  for (const RoofLine& line : lines) segments.push_back({line.a, line.b, line.eaves ? kEaves : kCrease});
  const PlanarLines planar = make_planar(std::move(segments));
  std::vector<RoofLine> result;
  for (const PlanarEdge& e : planar.edges) {
    const RoofLine line{planar.vertices[e.from], planar.vertices[e.to], e.owner == kEaves};
    const bool again = !result.empty() && result.back().a == line.a && result.back().b == line.b;
    if (again) {
      result.back().eaves = true;  // a crease along the ring
    } else {
      result.push_back(line);
    }
  }
  return result;
}

std::vector<RoofLine> rectangle_roof(const GridPolygon& plan, const RoofHeights& heights, bool hipped) {
  const RectangleRise rise{enclosing_rectangle(plan.outline), hipped};
  const Pitch pitch = pitch_of(heights, rise.rectangle.half_width);
  const HeightAt height = [&](Point2 p) { return pitch.at(rise.at(p)); };
  std::vector<RoofLine> lines;
  add_rings(plan, height, lines);
  const PolygonSides sides(plan);
  for (const auto& [p, q] : rise.creases()) add_crease(sides, p, q, height, lines);
  return made_planar(lines);
}

std::vector<RoofLine> flat_roof(const GridPolygon& plan, double height) {
  std::vector<RoofLine> lines;
  add_rings(
      plan, [&](Point2) { return height; }, lines);
  return lines;
}

/// Whether all creases stay on the plan: a wrong skeleton shows by leaving it.
bool stays_inside(const GridPolygon& plan, const std::vector<RoofLine>& lines) {
  const auto strays = [&](const GridPoint& p) { return side_of(plan, {p.x, p.y}) == Side::outside; };
  return std::none_of(lines.begin(), lines.end(),
                      [&](const RoofLine& line) { return !line.eaves && (strays(line.a) || strays(line.b)); });
}

/// The most corners of a plan that gets a skeleton, which takes time that grows with the square of the corners and
/// more. No house has that many.
constexpr std::size_t kMostCorners = 1000;

/// Why a plan is not fit for CGAL, which does not check: it crashes or runs for ever where rings touch.
std::string unfit(const GridPolygon& plan) {
  std::vector<GridEdge> edges;
  std::set<Position> corners;
  for_each_edge(plan, [&](Position a, Position b) {
    edges.emplace_back(a, b);
    corners.insert(a);
  });
  if (edges.size() > kMostCorners) return "too many corners for a straight skeleton";
  if (corners.size() < edges.size() || !conflicts(edges).empty()) return "its outline touches itself";
  return {};
}

RoofLines skeleton_roof(const GridPolygon& plan, const RoofHeights& heights) {
  if (std::string reason = unfit(plan); !reason.empty())
    return {flat_roof(plan, flat_height(heights)), std::move(reason)};
  const auto arcs = straight_skeleton(plan);
  if (!arcs) return {flat_roof(plan, flat_height(heights)), "the straight skeleton was refused"};
  double run = 0;
  for (const SkeletonArc& arc : *arcs) run = std::max({run, arc.rise_a, arc.rise_b});
  const Pitch pitch = pitch_of(heights, run);
  std::vector<RoofLine> lines;
  for (const SkeletonArc& arc : *arcs)
    lines.push_back({rounded(arc.a, pitch.at(arc.rise_a)), rounded(arc.b, pitch.at(arc.rise_b)), false});
  if (!stays_inside(plan, lines))
    return {flat_roof(plan, flat_height(heights)), "the straight skeleton leaves the footprint"};
  add_rings(
      plan, [&](Point2) { return pitch.eaves; }, lines);
  return {made_planar(lines), {}};
}

}  // namespace

RoofLines make_roof(RoofKind kind, const GridPolygon& plan, const RoofHeights& heights) {
  switch (kind) {
    case RoofKind::gabled:
    case RoofKind::hipped:
      return {rectangle_roof(plan, heights, kind == RoofKind::hipped), {}};
    case RoofKind::skeleton:
      return skeleton_roof(plan, heights);
    case RoofKind::flat:
      break;
  }
  return {flat_roof(plan, flat_height(heights)), {}};
}

}  // namespace itin
