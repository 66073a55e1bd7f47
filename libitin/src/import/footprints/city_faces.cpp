#include "import/footprints/city_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "features/mesh/prepare_feature.hpp"
#include "features/plan/plan_on_grid.hpp"

namespace itin {

namespace {

using Index = std::uint32_t;
using Rings = std::vector<std::vector<Index>>;

/// Planes that differ by less than this in direction, and in metres, are one.
constexpr double kSameDirection = 1e-3, kSamePlace = 0.02;
/// Faces are compared in plan on a grid of this, metres.
constexpr double kPlanStep = 0.01;
/// What is open of a face that others cover is at least as wide as this, metres; less is rounding.
constexpr double kOpenStrip = 0.02;

struct FacePlane {
  std::array<double, 3> normal{};  ///< a unit vector
  double offset = 0;

  double height_at(Point2 p) const { return (offset - normal[0] * p.x - normal[1] * p.y) / normal[2]; }
};

/// Newell's plane of a ring.
FacePlane plane_of(const std::vector<Index>& ring, const std::vector<Point3>& vertices) {
  const Point3& o = vertices[ring.front()];
  std::array<double, 3> n{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 &p = vertices[ring[i]], &q = vertices[ring[(i + 1) % ring.size()]];
    n[0] += (p.y - o.y) * (q.z - o.z) - (p.z - o.z) * (q.y - o.y);
    n[1] += (p.z - o.z) * (q.x - o.x) - (p.x - o.x) * (q.z - o.z);
    n[2] += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  }
  const double length = std::hypot(n[0], n[1], n[2]);
  if (length > 0) n = {n[0] / length, n[1] / length, n[2] / length};
  return {n, n[0] * o.x + n[1] * o.y + n[2] * o.z};
}

bool is_upright(const FacePlane& plane) {
  return std::hypot(plane.normal[0], plane.normal[1]) >= kSteepestRoof * std::abs(plane.normal[2]);
}

/// A face that is no wall, turned to face up.
struct UpwardFace {
  Rings rings;
  FacePlane plane;
  FaceName name;
  bool faced_down;
};

UpwardFace turned_up(const CityFace& face, FacePlane plane) {
  UpwardFace up{face.rings, plane, face.name, plane.normal[2] < 0};
  if (!up.faced_down) return up;
  for (auto& ring : up.rings) std::reverse(ring.begin(), ring.end());
  for (double& part : up.plane.normal) part = -part;
  up.plane.offset = -up.plane.offset;
  return up;
}

bool in_one_plane(const UpwardFace& a, const UpwardFace& b, const Point3& shared) {
  double deviation = 0;
  for (std::size_t i = 0; i < 3; ++i) deviation = std::max(deviation, std::abs(a.plane.normal[i] - b.plane.normal[i]));
  const auto off = [&](const FacePlane& plane) {
    const auto& n = plane.normal;
    return std::abs(n[0] * shared.x + n[1] * shared.y + n[2] * shared.z - plane.offset);
  };
  return a.name == b.name && deviation < kSameDirection && off(a.plane) < kSamePlace && off(b.plane) < kSamePlace;
}

template <class Visit>
void for_each_edge_of(const Rings& rings, const Visit& visit) {
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
}

/// The edges that have a face on one side only, as rings.
Rings outline_of(const std::vector<const UpwardFace*>& faces) {
  if (faces.size() == 1) return faces.front()->rings;
  std::multiset<std::pair<Index, Index>> edges;
  for (const UpwardFace* face : faces) {
    for_each_edge_of(face->rings, [&](Index a, Index b) {
      const auto reverse = edges.find({b, a});
      if (reverse == edges.end()) {
        edges.insert({a, b});
      } else {
        edges.erase(reverse);
      }
    });
  }
  Rings rings;
  while (!edges.empty()) {
    std::vector<Index>& ring = rings.emplace_back();
    auto edge = edges.begin();
    // Every vertex has as many edges in as out, so a walk ends where it began.
    while (edge != edges.end()) {
      const Index next = edge->second;
      ring.push_back(edge->first);
      edges.erase(edge);
      edge = edges.lower_bound({next, 0});
      if (edge != edges.end() && edge->first != next) edge = edges.end();
    }
  }
  return rings;
}

/// Joins faces where they share an edge, a plane and a name.
std::vector<UpwardFace> joined(const std::vector<UpwardFace>& faces, const std::vector<Point3>& vertices) {
  const auto count = static_cast<std::uint32_t>(faces.size());
  DisjointSets sets(count);
  std::map<std::pair<Index, Index>, std::uint32_t> left_of;
  for (std::uint32_t f = 0; f < count; ++f)
    for_each_edge_of(faces[f].rings, [&](Index a, Index b) { left_of[{a, b}] = f; });
  for (const auto& [edge, f] : left_of) {
    const auto other = left_of.find({edge.second, edge.first});
    if (other != left_of.end() && in_one_plane(faces[f], faces[other->second], vertices[edge.first]))
      sets.join(f, other->second);
  }
  std::map<std::uint32_t, std::vector<const UpwardFace*>> groups;
  for (std::uint32_t f = 0; f < count; ++f) groups[sets.least(f)].push_back(&faces[f]);
  std::vector<UpwardFace> pieces;
  for (const auto& [first, group] : groups)
    pieces.push_back({outline_of(group), faces[first].plane, faces[first].name, faces[first].faced_down});
  return pieces;
}

double length_of(const GridPolygons& polygons) {
  double length = 0;
  for (const GridPolygon& polygon : polygons)
    for_each_edge(polygon,
                  [&](Position a, Position b) { length += std::hypot(double{1} * b.x - a.x, double{1} * b.y - a.y); });
  return length;
}

/// Finds the pieces that are open to the sky.
class SeenFromAbove {
 public:
  /// `highest` is the elevation of the highest vertex of the building.
  SeenFromAbove(const std::vector<UpwardFace>& pieces, const std::vector<Point3>& vertices, double highest)
      : pieces_(pieces), highest_(highest) {
    if (pieces.empty()) return;
    const Point3& corner = vertices[pieces.front().rings.front().front()];
    grid_ = {{corner.x, corner.y}, kPlanStep};
    for (const UpwardFace& piece : pieces) seen_.push_back(placed(piece, vertices));
    for (std::size_t i = 0; i < seen_.size(); ++i)
      for (std::size_t k = i + 1; k < seen_.size(); ++k) compare(i, k);
  }

  bool is_top(std::size_t i) const { return has_area(i) && !is_floor(i) && is_open(i); }

 private:
  struct Seen {
    GridPolygons plan, covers;  ///< what the piece takes up, and the parts of it that lie under others
    GridBox box;
    double high = -std::numeric_limits<double>::infinity();
    bool over_others = false;
  };

  Seen placed(const UpwardFace& piece, const std::vector<Point3>& vertices) const {
    Seen seen;
    std::vector<std::vector<Point2>> rings;
    for (const auto& ring : piece.rings) {
      auto& points = rings.emplace_back();
      for (const Index v : ring) {
        points.push_back({vertices[v].x, vertices[v].y});
        seen.high = std::max(seen.high, vertices[v].z);
      }
    }
    if (auto plan = plan_on_grid(rings, grid_)) seen.plan = std::move(plan->polygons);
    for (const GridPolygon& polygon : seen.plan)
      for (const Position& p : polygon.outline) seen.box.extend(p.x, p.y);
    return seen;
  }

  void compare(std::size_t i, std::size_t k) {
    Seen &a = seen_[i], &b = seen_[k];
    if (!a.box.meets(b.box)) return;
    for (GridPolygon& common : common_part(a.plan, b.plan)) {
      const auto [least, greatest] = lead(i, k, common.outline);
      if (greatest > kSamePlace && least >= -kSamePlace)
        cover(b, a, std::move(common));
      else if (least < -kSamePlace && greatest <= kSamePlace)
        cover(a, b, std::move(common));
    }
  }

  static void cover(Seen& lower, Seen& upper, GridPolygon&& common) {
    lower.covers.push_back(std::move(common));
    upper.over_others = true;
  }

  /// The least and greatest height of piece i above piece k at these places.
  std::pair<double, double> lead(std::size_t i, std::size_t k, const GridRing& ring) const {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const Position& p : ring) {
      const Point2 place = grid_.position(p.x, p.y);
      const double height = pieces_[i].plane.height_at(place) - pieces_[k].plane.height_at(place);
      least = std::min(least, height), greatest = std::max(greatest, height);
    }
    return {least, greatest};
  }

  /// Roofs that stand upright have no area, and are left to those who raise the building to report.
  bool has_area(std::size_t i) const { return !seen_[i].plan.empty() || pieces_[i].name == FaceName::roof; }

  bool is_floor(std::size_t i) const {
    const UpwardFace& piece = pieces_[i];
    const bool may_be = piece.name == FaceName::ground || (piece.name == FaceName::other && piece.faced_down);
    return may_be && !seen_[i].over_others && seen_[i].high < highest_ - kSamePlace;
  }

  bool is_open(std::size_t i) const {
    const Seen& seen = seen_[i];
    if (seen.covers.empty()) return true;
    const double open = area(seen.plan) - area(merged(seen.covers));
    return open > length_of(seen.plan) * kOpenStrip / kPlanStep;
  }

  const std::vector<UpwardFace>& pieces_;
  const double highest_;
  Grid grid_;
  std::vector<Seen> seen_;
};

RoofSurface surface_of(const UpwardFace& piece, const std::vector<Point3>& vertices) {
  RoofSurface surface;
  for (const auto& ring : piece.rings) {
    auto& points = surface.rings.emplace_back();
    for (const Index v : ring) points.push_back(vertices[v]);
  }
  return surface;
}

/// The least and greatest elevation of faces; the least is above the greatest where there are none.
std::pair<double, double> height_range_of(const std::vector<const CityFace*>& faces,
                                          const std::vector<Point3>& vertices) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const CityFace* face : faces)
    for (const auto& ring : face->rings)
      for (const Index v : ring) least = std::min(least, vertices[v].z), greatest = std::max(greatest, vertices[v].z);
  return {least, greatest};
}

}  // namespace

BuildingTop top_of(const std::vector<CityFace>& faces, const std::vector<Point3>& vertices) {
  BuildingTop top;
  std::vector<const CityFace*> all, grounds;
  std::vector<UpwardFace> upward;
  for (const CityFace& face : faces) {
    all.push_back(&face);
    if (face.name == FaceName::ground) grounds.push_back(&face);
    const FacePlane plane = plane_of(face.rings.front(), vertices);
    const bool upright = is_upright(plane);
    if (face.name == FaceName::closure) {
      top.closures += upright ? 0 : 1;
    } else if (!upright || face.name == FaceName::roof) {
      upward.push_back(turned_up(face, plane));
    }
  }
  const auto [lowest, highest] = height_range_of(all, vertices);
  const std::vector<UpwardFace> pieces = joined(upward, vertices);
  const SeenFromAbove seen(pieces, vertices, highest);
  bool confused = false;  // a top is called ground
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!seen.is_top(i)) continue;
    confused |= pieces[i].name == FaceName::ground;
    top.surfaces.push_back(surface_of(pieces[i], vertices));
  }
  top.base = grounds.empty() || confused ? lowest : height_range_of(grounds, vertices).first;
  return top;
}

}  // namespace itin
