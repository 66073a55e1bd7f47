#include "features/mesh/footprint_arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <itin/precondition.hpp>

#include "base/disjoint_sets.hpp"
#include "base/stoppable.hpp"
#include "features/mesh/terrain_heights.hpp"
#include "features/plan/mask_index.hpp"
#include "features/plan/planar.hpp"

namespace itin {

namespace {

constexpr std::uint32_t kNobody = 0xffffffff;

/// How far, in offsets, a corner of the top may be from the end of the border beside it, where they meet at an angle.
constexpr double kCornerReach = 3;

std::vector<GridEdge> noded_outlines(const std::vector<Patch>& patches, const Progress* progress) {
  std::vector<OwnedSegment> segments;
  for (const Patch& patch : patches) {
    for (const GridPolygon& polygon : patch.plan)
      for_each_edge(polygon, [&](Position a, Position b) { segments.push_back({{a.x, a.y, 0}, {b.x, b.y, 0}, 0}); });
  }
  const PlanarLines lines = make_planar(std::move(segments), progress);
  std::vector<GridEdge> edges;
  edges.reserve(lines.edges.size());
  const auto position = [&](std::uint32_t v) { return Position{lines.vertices[v].x, lines.vertices[v].y}; };
  for (const PlanarEdge& e : lines.edges) edges.emplace_back(position(e.from), position(e.to));
  return edges;
}

/// Tells which boxes may hold a position. There are about as many cells as boxes; each knows the boxes that meet it.
class BoxCells {
 public:
  explicit BoxCells(const std::vector<GridBox>& boxes) {
    for (const GridBox& box : boxes) bounds_.extend(box);
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(boxes.size()))));
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].empty()) continue;
      for (int r = row(boxes[i].ymin); r <= row(boxes[i].ymax); ++r)
        for (int c = column(boxes[i].xmin); c <= column(boxes[i].xmax); ++c) cells_[number(c, r)].push_back(i);
    }
  }
  /// The numbers of the boxes that may hold p, ascending.
  const std::vector<std::uint32_t>& at(Point2 p) const { return cells_[number(column(p.x), row(p.y))]; }

 private:
  int cell(double v, double low, double high) const {
    return high <= low ? 0 : std::clamp(static_cast<int>((v - low) / (high - low) * side_), 0, side_ - 1);
  }
  int column(double x) const { return cell(x, bounds_.xmin, bounds_.xmax); }
  int row(double y) const { return cell(y, bounds_.ymin, bounds_.ymax); }
  std::size_t number(int c, int r) const { return static_cast<std::size_t>(r) * side_ + c; }

  GridBox bounds_;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

class Arranging {
 public:
  Arranging(const std::vector<Patch>& patches, double offset, const Progress* progress)
      : patches_(patches), offset_(offset), progress_(progress) {}

  Arrangement run() {
    share_out();
    find_neighbours();
    for (std::uint32_t i = 0; i < patches_.size(); ++i) {
      try {
        result_.patches[i].top = top_of(i);
      } catch (const OverlayError& error) {
        result_.patches[i].failure = error.what();
      }
    }
    for (const ArrangedPatch& patch : result_.patches) corners_.push_back(corners_of(patch.top));
    for (std::uint32_t i = 0; i < patches_.size(); ++i) find_joints(i);
    return std::move(result_);
  }

 private:
  std::uint32_t owner_at(const BoxCells& cells, Point2 p) const {
    std::uint32_t owner = kNobody;
    for (const std::uint32_t i : cells.at(p)) {
      if (!plans_[i].encloses(p)) continue;
      if (owner == kNobody || patches_[i].top.at(p) > patches_[owner].top.at(p)) owner = i;
    }
    return owner;
  }

  void share_out() {
    std::vector<GridBox> boxes;
    for (const Patch& patch : patches_) {
      boxes.push_back(bounds_of(patch.plan));
      plans_.emplace_back(patch.plan);
    }
    const BoxCells cells(boxes);
    std::vector<GridPolygons> faces(patches_.size());
    for (PlanFace& face : faces_of(noded_outlines(patches_, progress_))) {
      const std::uint32_t owner = owner_at(cells, face.inside);
      if (owner == kNobody) continue;
      for_each_edge(face.polygon, [&](Position a, Position b) {
        stop_if_asked();
        left_of_[{a, b}] = owner;
      });
      faces[owner].push_back(std::move(face.polygon));
    }
    result_.patches.resize(patches_.size());
    for (std::size_t i = 0; i < faces.size(); ++i) result_.patches[i].footprint = united(faces[i]);
  }

  void find_neighbours() {
    neighbours_.resize(patches_.size());
    for (const auto& [edge, owner] : left_of_) {
      stop_if_asked();
      const auto other = left_of_.find({edge.second, edge.first});
      if (other == left_of_.end()) {
        result_.feet.emplace_back(edge, owner);
      } else if (other->second != owner) {
        neighbours_[owner].insert(other->second);
      }
    }
  }

  bool lower(std::uint32_t a, std::uint32_t b) const {
    return patches_[a].rank != patches_[b].rank ? patches_[a].rank < patches_[b].rank : a > b;
  }

  GridPolygons top_of(std::uint32_t i) const {
    const GridPolygons& own = result_.patches[i].footprint;
    GridPolygons ground = own;
    for (const std::uint32_t n : neighbours_[i]) {
      if (!lower(n, i)) continue;
      const GridPolygons& theirs = result_.patches[n].footprint;
      ground.insert(ground.end(), theirs.begin(), theirs.end());
    }
    if (ground.size() == own.size()) return eroded(own, offset_);
    return common_part(own, eroded(united(ground), offset_));
  }

  /// The patch to the right of a patch's edge.
  std::uint32_t beyond(Position a, Position b) const {
    const auto other = left_of_.find({b, a});
    return other == left_of_.end() ? kNobody : other->second;
  }

  /// The corners of a top's rings, ascending.
  static std::vector<Position> corners_of(const GridPolygons& top) {
    std::vector<Position> corners;
    for (const GridPolygon& polygon : top)
      for_each_ring(polygon, [&](const GridRing& ring) { corners.insert(corners.end(), ring.begin(), ring.end()); });
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  /// The corner of a top that is nearest to a place on its outline, as far as one is nearby.
  std::optional<Position> corner_at(Position place, std::uint32_t patch) const {
    const auto reach = static_cast<std::int32_t>(kCornerReach * offset_) + 1;
    const std::vector<Position>& corners = corners_[patch];
    std::optional<Position> best;
    std::int64_t least = std::int64_t{reach} * reach;
    const Position first{place.x - reach, std::numeric_limits<std::int32_t>::min()};
    for (auto at = std::lower_bound(corners.begin(), corners.end(), first);
         at != corners.end() && at->x <= place.x + reach; ++at) {
      const std::int64_t x = std::int64_t{at->x} - place.x, y = std::int64_t{at->y} - place.y;
      if (x * x + y * y < least) least = x * x + y * y, best = *at;
    }
    return best;
  }

  void find_joints(std::uint32_t i) {
    ArrangedPatch& patch = result_.patches[i];
    // Beside a lower neighbour the wall stands in that neighbour. There the top reaches to its outline, and bends where
    // the wall begins.
    const auto rises = [&](std::uint32_t n) { return n == kNobody || !lower(n, i); };
    const auto add_joint = [&](Position p, std::uint32_t n) {
      if (!rises(n)) return;
      const std::optional<Position> end = n == kNobody ? p : corner_at(p, n);
      if (end) patch.joints.push_back(*end);
    };
    for (const GridPolygon& polygon : patch.footprint) {
      for_each_ring(polygon, [&](const GridRing& ring) {
        std::uint32_t before = beyond(ring.back(), ring.front());
        for (std::size_t k = 0; k < ring.size(); ++k) {
          stop_if_asked();
          const std::uint32_t after = beyond(ring[k], ring[(k + 1) % ring.size()]);
          if (before != after) {
            if (rises(before) && rises(after)) patch.leaps.push_back(ring[k]);
            add_joint(ring[k], before);
            add_joint(ring[k], after);
          }
          before = after;
        }
      });
    }
  }

  const std::vector<Patch>& patches_;
  const double offset_;
  const Progress* progress_;
  std::vector<MaskIndex> plans_;  ///< by patch
  std::map<GridEdge, std::uint32_t> left_of_;
  std::vector<std::set<std::uint32_t>> neighbours_;
  std::vector<std::vector<Position>> corners_;  ///< corners of the tops, by patch
  Arrangement result_;
};

}  // namespace

Arrangement arrange(const std::vector<Patch>& patches, double offset, const Progress* progress) {
  ITIN_PRECONDITION(offset >= 2);
  return Arranging(patches, offset, progress).run();
}

std::vector<std::vector<std::uint32_t>> groups_of(const std::vector<GridBox>& boxes) {
  // Sweeps along x with the open boxes ordered by their least y: only boxes that begin below a box's top are tried.
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return boxes[a].xmin != boxes[b].xmin ? boxes[a].xmin < boxes[b].xmin : a < b; });
  std::int32_t tallest = 0;
  for (const GridBox& box : boxes)
    if (!box.empty()) tallest = std::max(tallest, box.ymax - box.ymin);
  DisjointSets groups(boxes.size());
  std::multimap<std::int32_t, std::uint32_t> open;
  for (const std::uint32_t i : order) {
    if (boxes[i].empty()) continue;
    // No box that begins further below than the tallest box is high reaches this one.
    const std::int64_t from = std::int64_t{boxes[i].ymin} - tallest - 2;
    auto at = open.lower_bound(static_cast<std::int32_t>(std::max<std::int64_t>(from, -kGridHalfSide)));
    while (at != open.end() && at->first <= boxes[i].ymax + 1) {
      const GridBox& other = boxes[at->second];
      if (other.xmax + 1 < boxes[i].xmin) {
        at = open.erase(at);
        continue;
      }
      if (other.ymax + 1 >= boxes[i].ymin) groups.join(i, at->second);
      ++at;
    }
    open.emplace(boxes[i].ymin, i);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) members[groups.least(i)].push_back(i);
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [first, group] : members) result.push_back(std::move(group));
  return result;
}

}  // namespace itin
