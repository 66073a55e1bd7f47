#include "features/contours/flat_skeleton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

#include <itin/segment_distance.hpp>

#include "geometry/cell.hpp"
#include "geometry/predicates.hpp"

namespace itin {

namespace {

using Passage = FlatTriangles::Passage;
using FlatSide = FlatTriangles::Side;
using FlatTriangle = FlatTriangles::Triangle;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kFar = std::numeric_limits<double>::infinity();

Point2 flat_point(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

double distance_to_segment(Point2 p, const GridPoint& from, const GridPoint& to) {
  return itin::distance_to_segment(p, flat_point(from), flat_point(to));
}

bool strictly_inside(const GridPoint& a, const GridPoint& b, const GridPoint& c, Position p) {
  const int side = orientation(a, b, c);
  return orientation(a, b, p) == side && orientation(b, c, p) == side && orientation(c, a, p) == side;
}

/// A node of the skeleton. Its height is relative to the region's.
struct Node {
  Point2 place;
  double height = kUnknown;
  std::optional<Position> position;  ///< where to infer a point; none for vertices that are there, or where none fits
  bool tip = false;
  std::vector<std::pair<std::uint32_t, double>> links;  ///< neighbours and distances
};

/// The shape of the ground in the contour intervals beside the region.
struct Surroundings {
  double slope = kUnknown;     ///< mean, along the region's contours
  double interval = kUnknown;  ///< the least difference from a neighbouring contour
  double outside = 0;          ///< > 0 where the ground beyond the contours rises
};

/// The distance to the nearest of many sides.
class NearestSide {
 public:
  void add(const GridPoint& a, const GridPoint& b) { sides_.push_back(a.x < b.x ? Ends{a, b} : Ends{b, a}); }
  void sort() {
    std::sort(sides_.begin(), sides_.end(), [](const Ends& s, const Ends& t) { return s.first.x < t.first.x; });
    for (const Ends& s : sides_) widest_ = std::max(widest_, static_cast<double>(s.second.x) - s.first.x);
  }

  double distance_from(Point2 p) const {
    const auto right =
        std::partition_point(sides_.begin(), sides_.end(), [&](const Ends& s) { return s.first.x < p.x; });
    double least = kFar;
    for (auto s = right; s != sides_.end() && s->first.x - p.x < least; ++s)
      least = std::min(least, distance_to_segment(p, s->first, s->second));
    for (auto s = right; s != sides_.begin() && p.x - std::prev(s)->first.x - widest_ < least; --s)
      least = std::min(least, distance_to_segment(p, std::prev(s)->first, std::prev(s)->second));
    return least;
  }

 private:
  using Ends = std::pair<GridPoint, GridPoint>;
  std::vector<Ends> sides_;  ///< each from left to right; sorted by left end
  double widest_ = 0;
};

class Skeleton {
 public:
  Skeleton(const FlatTriangles& flat, const FlatTriangles::Region& region)
      : flat_(flat), base_(flat.triangles()[region.front()].corners[0].z) {
    for (const std::uint32_t t : region) add(t);
    measure_surroundings(region);
  }

  std::vector<GridPoint> run() {
    if (exits_.empty()) {
      raise_roof();
    } else {
      grow_from_exits();
      lay_trunks();
    }
    return points();
  }

 private:
  struct Way {
    double distance = kFar;
    std::uint32_t before = 0, exit = 0;
    bool settled = false;
  };
  /// A way from a terminal, whose height is known, along `next` and on to an exit.
  struct Trunk {
    bool from_tip;
    double distance;
    std::uint32_t terminal, next;
    auto order() const { return std::tuple(from_tip, -distance, terminal, next); }
  };

  const FlatTriangle& triangle(std::uint32_t t) const { return flat_.triangles()[t]; }

  std::uint32_t add_node(Node node) {
    nodes_.push_back(std::move(node));
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  void link(std::uint32_t a, std::uint32_t b) {
    const double length = distance(nodes_[a].place, nodes_[b].place);
    nodes_[a].links.emplace_back(b, length);
    nodes_[b].links.emplace_back(a, length);
  }

  void add(std::uint32_t t) {
    std::vector<std::uint32_t> open;
    std::size_t last = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle(t).sides[i].passage == Passage::kClosed) continue;
      open.push_back(middle_of(t, i));
      last = i;
    }
    if (open.size() == 2) return link(open[0], open[1]);
    const std::uint32_t centre = open.size() == 1 ? tip(triangle(t).corners[last]) : centroid(triangle(t));
    for (const std::uint32_t node : open) link(centre, node);
  }

  std::uint32_t tip(const GridPoint& p) {
    Node node{.place = flat_point(p), .height = 0, .position = {}, .tip = true, .links = {}};
    return add_node(std::move(node));
  }

  std::uint32_t centroid(const FlatTriangle& t) {
    const auto& [a, b, c] = t.corners;
    Node node;
    node.place = {(static_cast<double>(a.x) + b.x + c.x) / 3, (static_cast<double>(a.y) + b.y + c.y) / 3};
    const Position p{static_cast<std::int32_t>(std::lround(node.place.x)),
                     static_cast<std::int32_t>(std::lround(node.place.y))};
    if (strictly_inside(a, b, c, p)) node.position = p;
    return add_node(std::move(node));
  }

  /// The middle of a side, which both triangles at it share; beyond an exit the way leads on to the vertex there.
  std::uint32_t middle_of(std::uint32_t t, std::size_t i) {
    const FlatTriangle& own = triangle(t);
    const FlatSide& side = own.sides[i];
    const GridPoint &a = own.corners[(i + 1) % 3], &b = own.corners[(i + 2) % 3];
    const auto [known, fresh] = middles_.try_emplace(std::minmax({code_of(a), code_of(b)}), 0);
    if (fresh) known->second = add_node(middle_node(own, i, a, b));
    const std::uint32_t node = known->second;
    if (side.passage == Passage::kExit) {
      Node beyond{.place = flat_point(side.beyond),
                  .height = static_cast<double>(side.beyond.z) - base_,
                  .position = {},
                  .tip = false,
                  .links = {}};
      exits_.push_back(add_node(std::move(beyond)));
      link(node, exits_.back());
    }
    return node;
  }

  static Node middle_node(const FlatTriangle& own, std::size_t i, const GridPoint& a, const GridPoint& b) {
    Node node;
    node.place = {(static_cast<double>(a.x) + b.x) / 2, (static_cast<double>(a.y) + b.y) / 2};
    const Position p{static_cast<std::int32_t>((std::int64_t{a.x} + b.x) >> 1),
                     static_cast<std::int32_t>((std::int64_t{a.y} + b.y) >> 1)};
    const bool is_end = p == Position{a.x, a.y} || p == Position{b.x, b.y};
    if (!is_end && (orientation(a, b, p) == 0 || strictly_inside(a, b, own.corners[i], p) ||
                    strictly_inside(a, b, own.sides[i].beyond, p))) {
      node.position = p;
    }
    return node;
  }

  void measure_surroundings(const FlatTriangles::Region& region) {
    double length = 0, slope = 0;
    for (const std::uint32_t t : region) {
      for (std::size_t i = 0; i < 3; ++i) {
        const FlatSide& side = triangle(t).sides[i];
        const GridPoint &a = triangle(t).corners[(i + 1) % 3], &b = triangle(t).corners[(i + 2) % 3];
        if (side.passage == Passage::kClosed) contours_.add(a, b);
        const double rise = static_cast<double>(side.beyond.z) - base_;
        if (!side.ground_beyond || side.passage == Passage::kFlat || rise == 0) continue;
        if (side.contour_beyond) {
          around_.interval = std::isnan(around_.interval) ? std::abs(rise) : std::min(around_.interval, std::abs(rise));
        }
        if (side.passage == Passage::kExit) continue;
        const double weight = distance(flat_point(a), flat_point(b));
        length += weight;
        slope += weight * std::abs(rise) / distance_to_segment(flat_point(side.beyond), a, b);
        around_.outside += rise > 0 ? weight : -weight;
      }
    }
    if (length > 0) around_.slope = slope / length;
    contours_.sort();
  }

  /// How far the ground at a place is from the contour's height, at most `most`.
  double extrapolated(Point2 place, double most) const {
    return std::isnan(around_.slope) ? most : std::min(around_.slope * contours_.distance_from(place), most);
  }

  void raise_roof() {
    if (std::isnan(around_.slope) || std::isnan(around_.interval) || around_.outside == 0) return;
    const double sign = around_.outside < 0 ? 1 : -1;
    for (Node& node : nodes_) {
      if (!node.tip) node.height = sign * extrapolated(node.place, around_.interval / 2);
    }
  }

  /// The shortest way from each node to an exit (Dijkstra).
  void grow_from_exits() {
    ways_.assign(nodes_.size(), {});
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const std::uint32_t e : exits_) {
      ways_[e] = {0, e, e, false};
      queue.emplace(0.0, e);
    }
    while (!queue.empty()) {
      const std::uint32_t at = queue.top().second;
      queue.pop();
      if (ways_[at].settled) continue;
      ways_[at].settled = true;
      for (const auto& [next, length] : nodes_[at].links) {
        if (ways_[at].distance + length >= ways_[next].distance) continue;
        ways_[next] = {ways_[at].distance + length, at, ways_[at].exit, false};
        queue.emplace(ways_[next].distance, next);
      }
    }
  }

  void lay_trunks() {
    std::vector<Trunk> trunks;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].tip) trunks.push_back({true, ways_[n].distance, n, n});
      for (const auto& [other, length] : nodes_[n].links) add_pass(n, other, trunks);
    }
    std::sort(trunks.begin(), trunks.end(), [](const Trunk& s, const Trunk& t) { return s.order() < t.order(); });
    for (const Trunk& trunk : trunks) {
      if (!trunk.from_tip && std::isnan(nodes_[trunk.terminal].height))
        nodes_[trunk.terminal].height = pass_height(trunk.terminal, trunk.next);
      if (!trunk.from_tip) lay(trunk.terminal, trunk.terminal);
      lay(trunk.terminal, trunk.next);
    }
  }

  /// Adds a trunk where ways to exits meet. It starts at the farther node of the link between them.
  void add_pass(std::uint32_t n, std::uint32_t other, std::vector<Trunk>& trunks) const {
    const Way &way = ways_[n], &to = ways_[other];
    if (way.before == other || to.before == n) return;
    if (std::pair(way.distance, n) > std::pair(to.distance, other)) trunks.push_back({false, way.distance, n, other});
  }

  double pass_height(std::uint32_t n, std::uint32_t other) const {
    const double here = nodes_[ways_[n].exit].height, there = nodes_[ways_[other].exit].height;
    if (here * there <= 0) return 0;
    double most = std::min(std::abs(here), std::abs(there)) / 2;
    if (!std::isnan(around_.interval)) most = std::min(most, around_.interval / 2);
    return std::copysign(extrapolated(nodes_[n].place, most), here);
  }

  /// Gives even heights to the nodes from a terminal by way of `next` to the first node on the way to the exit that has
  /// a height.
  void lay(std::uint32_t terminal, std::uint32_t next) {
    std::vector<std::pair<std::uint32_t, double>> passed;
    double length = next == terminal ? 0 : distance(nodes_[terminal].place, nodes_[next].place);
    std::uint32_t at = next;
    while (at == terminal || std::isnan(nodes_[at].height)) {
      if (at != terminal) passed.emplace_back(at, length);
      const std::uint32_t before = ways_[at].before;
      length += ways_[at].distance - ways_[before].distance;
      at = before;
    }
    const double from = nodes_[terminal].height, to = nodes_[at].height;
    for (const auto& [node, along] : passed) nodes_[node].height = from + (to - from) * along / length;
  }

  std::vector<GridPoint> points() const {
    std::vector<GridPoint> result;
    for (const Node& node : nodes_) {
      if (!node.position || std::isnan(node.height)) continue;
      const auto z = base_ + static_cast<std::int32_t>(std::lround(node.height));
      if (z != base_) result.push_back({node.position->x, node.position->y, z});
    }
    return result;
  }

  const FlatTriangles& flat_;
  std::int32_t base_;
  std::vector<Node> nodes_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint32_t> middles_;  ///< by the ends of the side
  std::vector<std::uint32_t> exits_;                                          ///< the vertices beyond
  NearestSide contours_;                                                      ///< contours and borders of the region
  Surroundings around_;
  std::vector<Way> ways_;
};

}  // namespace

std::vector<GridPoint> infer_points(const FlatTriangles& flat, const FlatTriangles::Region& region) {
  return Skeleton(flat, region).run();
}

}  // namespace itin
