#include "triangulate/apex/apex.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <itin/box_of.hpp>

#include "geometry/box_gap.hpp"
#include "triangulate/apex/apex_frame.hpp"
#include "triangulate/apex/sight_fan.hpp"

namespace itin {

namespace {

/// The number of nearest segments that are tried before the others.
constexpr std::ptrdiff_t kNearSegments = 16;
/// With fewer segments or questions, sorting segments by direction does not pay.
constexpr std::size_t kFewSegments = 64, kFewQuestions = 4;
/// A circle is wide when its centre is farther away than this many times half the edge's length. Narrower circles are
/// searched first.
constexpr double kWide = 4;

double width(const GridBox& b) {
  return static_cast<double>(b.xmax) - b.xmin;
}
double height(const GridBox& b) {
  return static_cast<double>(b.ymax) - b.ymin;
}

/// Calls visit(part) for at most four boxes that together have the positions of `box` without those of `hole`.
template <class Visit>
void for_each_part_beyond(GridBox box, const GridBox& hole, const Visit& visit) {
  if (hole.empty() || !box.meets(hole)) return visit(box);
  if (box.xmin < hole.xmin) visit({box.xmin, box.ymin, hole.xmin - 1, box.ymax});
  if (box.xmax > hole.xmax) visit({hole.xmax + 1, box.ymin, box.xmax, box.ymax});
  box.xmin = std::max(box.xmin, hole.xmin), box.xmax = std::min(box.xmax, hole.xmax);
  if (box.ymin < hole.ymin) visit({box.xmin, box.ymin, box.xmax, hole.ymin - 1});
  if (box.ymax > hole.ymax) visit({box.xmin, hole.ymax + 1, box.xmax, box.ymax});
}

/// Returns the halves of a box. Both have the positions on the cut, so that no leaf can fall between them.
std::pair<GridBox, GridBox> halves(const GridBox& b) {
  if (width(b) >= height(b)) {
    const std::int32_t x = std::midpoint(b.xmin, b.xmax);
    return {{b.xmin, b.ymin, x, b.ymax}, {x, b.ymin, b.xmax, b.ymax}};
  }
  const std::int32_t y = std::midpoint(b.ymin, b.ymax);
  return {{b.xmin, b.ymin, b.xmax, y}, {b.xmin, y, b.xmax, b.ymax}};
}

}  // namespace

bool crosses(const Segment& s, Position p, Position q) {
  const Position a = s.a(), b = s.b();
  return orientation(p, q, a) * orientation(p, q, b) < 0 && orientation(a, b, p) * orientation(a, b, q) < 0;
}

namespace {

/// Tells whether the segment hides the box from p. A segment's shadow is convex: it holds a box when it holds the
/// corners.
bool hides(const Segment& s, Position p, const GridBox& box) {
  return crosses(s, p, {box.xmin, box.ymin}) && crosses(s, p, {box.xmax, box.ymax}) &&
         crosses(s, p, {box.xmin, box.ymax}) && crosses(s, p, {box.xmax, box.ymin});
}

bool hide(std::span<const Segment> segments, Position a, Position b, const GridBox& box, int halvings) {
  const Position centre{std::midpoint(box.xmin, box.xmax), std::midpoint(box.ymin, box.ymax)};
  bool hidden = false;
  for (const Segment& s : segments) {
    for (const Position p : {a, b}) {
      if (!crosses(s, p, centre)) continue;
      if (hides(s, p, box)) return true;
      hidden = true;
    }
  }
  if (!hidden || halvings == 0) return false;
  const auto [first, second] = halves(box);
  return hide(segments, a, b, first, halvings - 1) && hide(segments, a, b, second, halvings - 1);
}

}  // namespace

bool hide(std::span<const Segment> segments, Position a, Position b, const GridBox& box) {
  constexpr int kShadowHalvings = 6;
  return !segments.empty() && hide(segments, a, b, box, kShadowHalvings);
}

/// The state of the search of one circle.
struct ApexSearch::Search {
  const ApexFrame& frame;
  GridBox box;  ///< everything that the search looks at, except `known`
  GridBox known;
  const Position* beyond;  ///< a position on the circle that the search must improve on, or null
  double reach;            ///< no circle larger than this matters any more
  Segments segments;       ///< whether segments hide anything
  std::optional<SelectedVertex> best = std::nullopt;
  GridBox with_segments = {};  ///< the part of box for which segments_ has the segments that meet it
  std::size_t asked = 0;       ///< number of questions so far about what segments_ hide
  std::optional<SightFan> from_a = std::nullopt, from_b = std::nullopt;
};

/// Reads the segments that may come between ab and the places left of ab in a part of the search's box, and perhaps
/// more. Near segments, which hide most, come first.
void ApexSearch::read_segments(const GridBox& part, Search& search) {
  if (search.segments == Segments::kPassed || search.with_segments.contains(part)) return;
  const ApexFrame& frame = search.frame;
  search.with_segments.extend(part);
  // Parts are made larger than asked for, as later ones grow; so few parts are read.
  const double margin = std::max(width(search.with_segments), height(search.with_segments)) / 2;
  search.with_segments = intersection(expanded(search.with_segments, margin), search.box);
  search.asked = 0;
  search.from_a.reset(), search.from_b.reset();
  segments_.clear();
  index_.segments(search.with_segments, segments_);
  std::erase_if(segments_, [&](const Segment& s) {
    const bool beside = orientation(frame.a, frame.b, s.a()) <= 0 && orientation(frame.a, frame.b, s.b()) <= 0;
    return beside || !selection_.selects(s);
  });
  if (std::ssize(segments_) <= kNearSegments) return;
  const auto distance = [&](const Segment& s) {
    const double x = s.ax - frame.mx, y = s.ay - frame.my;
    return x * x + y * y;
  };
  const auto nearest = segments_.begin() + kNearSegments;
  std::nth_element(segments_.begin(), nearest, segments_.end(),
                   [&](const Segment& s, const Segment& t) { return distance(s) < distance(t); });
}

/// Tells whether a segment hides c from an end of the edge.
bool ApexSearch::hidden(Position c, Search& search) {
  const Position a = search.frame.a, b = search.frame.b;
  read_segments(intersection(box_of(std::array{a, b, c}), search.box), search);
  if (segments_.size() < kFewSegments || ++search.asked < kFewQuestions) {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const Segment& s) { return crosses(s, a, c) || crosses(s, b, c); });
  }
  if (!search.from_a) {
    search.from_a.emplace(a, b, a, segments_);
    search.from_b.emplace(a, b, b, segments_);
  }
  return search.from_a->blocked(c) || search.from_b->blocked(c);
}

std::optional<SelectedVertex> ApexSearch::least_circle(const ApexFrame& frame, double lambda, const Position* beyond,
                                                       const GridBox& known, Segments segments) {
  const GridBox all = index_.bounds();
  const double span = frame.r + std::hypot(width(all), height(all));
  // Where there are many vertices, the wanted one is near; where there are none, even a wide circle is soon searched.
  for (double part = frame.r; part < std::min(lambda / kWide, span); part *= kWide) {
    const auto best = nearest_circle(frame, part, nullptr, known, segments);
    // A point on the searched circle itself may have rivals that rounding left out.
    if (best && frame.lambda(best->position()) < 0.999 * part) return best;
  }
  return nearest_circle(frame, lambda, beyond, known, segments);
}

std::optional<SelectedVertex> ApexSearch::nearest_circle(const ApexFrame& frame, double lambda, const Position* beyond,
                                                         const GridBox& known, Segments segments) {
  Search search{frame, frame.cap_box(lambda, index_.bounds()), known, beyond, lambda, segments};
  if (search.box.empty()) return std::nullopt;
  segments_.clear();
  leaves_.clear();
  for_each_part_beyond(search.box, known,
                       [&](const GridBox& part) { selected_leaves(index_, selection_, part, leaves_); });
  std::vector<std::tuple<double, std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
    const GridBox box = leaves_[i].cell.box();
    if (frame.cap_meets(lambda, box)) order.emplace_back(frame.key(box), leaves_[i].key, i);
  }
  std::sort(order.begin(), order.end());
  const Leaf* last = nullptr;
  for (const auto& [key, leaf_key, i] : order) {
    if (last != nullptr && last->key == leaf_key) continue;  // the leaf meets several parts
    last = &leaves_[i];
    if (frame.cap_meets(search.reach, last->cell.box()) && !hidden(*last, search)) search_leaf(*last, search);
  }
  return search.best;
}

/// Tells whether it is certain, without reading the leaf, that nearby segments hide all of it.
bool ApexSearch::hidden(const Leaf& leaf, Search& search) {
  if (blocks_.has_read(leaf)) return false;
  read_segments(search.box, search);
  const std::span nearest(segments_.data(), std::min(segments_.size(), std::size_t{kNearSegments}));
  return hide(nearest, search.frame.a, search.frame.b, intersection(leaf.cell.box(), search.box));
}

void ApexSearch::search_leaf(const Leaf& leaf, Search& search) {
  const Position a = search.frame.a, b = search.frame.b;
  const auto block = blocks_.read(leaf);
  for (std::size_t k = 0; k < block->points.size(); ++k) {
    const GridPoint& point = block->points[k];
    const Position c{point.x, point.y};
    // Segments are known only for the search's box; places outside it are searched with a larger one.
    if (!search.box.contains(c.x, c.y) || search.known.contains(c.x, c.y) ||
        !search.frame.inside(search.reach, c.x, c.y) || orientation(a, b, c) <= 0)
      continue;
    const std::uint8_t level = level_of(leaf, *block, k);
    if (!selection_.selects(leaf, level, c.x, c.y)) continue;
    if (search.best ? in_circle_perturbed(a, b, search.best->position(), c) < 0
                    : search.beyond != nullptr && in_circle_perturbed(b, a, *search.beyond, c) < 0) {
      continue;
    }
    if (hidden(c, search)) continue;
    search.best = SelectedVertex{point, block->sources[k], level, block->theme(k)};
    search.reach = std::min(search.reach, search.frame.lambda(c));
  }
}

std::optional<SelectedVertex> ApexSearch::intruder(Position a, Position b, Position c) {
  const ApexFrame frame(a, b);
  return least_circle(frame, frame.lambda(c), &c, known_, Segments::kHide);
}

std::optional<SelectedVertex> ApexSearch::apex(Position a, Position b) {
  return left_of(a, b, Segments::kHide);
}

std::optional<SelectedVertex> ApexSearch::nearest_left_of(Position a, Position b) {
  return left_of(a, b, Segments::kPassed);
}

std::optional<SelectedVertex> ApexSearch::left_of(Position a, Position b, Segments segments) {
  const GridBox all = index_.bounds();
  // This is tested first, as there are many edges along the border of a raster.
  const Position farthest{b.y > a.y ? all.xmin : all.xmax, b.x > a.x ? all.ymax : all.ymin};
  if (orientation(a, b, farthest) <= 0) return std::nullopt;
  const ApexFrame frame(a, b);
  const double span = frame.r + std::hypot(width(all), height(all));
  // A grid position left of ab is at least 1 / |ab| away from it, so no circle is larger than this.
  return least_circle(frame, span * span * (frame.r + 1), nullptr, {}, segments);
}

std::optional<SelectedVertex> ApexSearch::inside(Position a, Position b, Position c, const GridBox& near) {
  const GridBox box = box_of(std::array{a, b, c});
  if (known_.contains(box)) return std::nullopt;
  const auto holds = [&](Position p) {
    return p != a && p != b && p != c && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
           orientation(c, a, p) >= 0;
  };
  std::optional<SelectedVertex> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [leaf_gap, leaf] : leaves_from(near, box)) {
    if (leaf_gap >= least) break;
    const auto block = blocks_.read(*leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& point = block->points[k];
      const Position p{point.x, point.y};
      if (!box.contains(p.x, p.y) || known_.contains(p.x, p.y)) continue;
      const double distance = squared_gap(near, {p.x, p.y, p.x, p.y});
      const std::uint8_t level = level_of(*leaf, *block, k);
      if (distance >= least || !holds(p) || !selection_.selects(*leaf, level, p.x, p.y)) continue;
      nearest = SelectedVertex{point, block->sources[k], level, block->theme(k)};
      least = distance;
    }
  }
  return nearest;
}

/// The leaves that meet `box`, each with the squared distance of its part in there from
/// `place`, ascending.
std::vector<std::pair<double, const Leaf*>> ApexSearch::leaves_from(const GridBox& place, const GridBox& box) {
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  std::vector<std::pair<double, const Leaf*>> found;
  for (const Leaf& leaf : leaves_) found.emplace_back(squared_gap(place, intersection(leaf.cell.box(), box)), &leaf);
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<SelectedVertex> ApexSearch::at(Position p) {
  const GridBox box{p.x, p.y, p.x, p.y};
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  for (const Leaf& leaf : leaves_) {
    const auto block = blocks_.read(leaf);
    const auto found = find_by_code(block->points, code_of(p));
    if (found == block->points.end()) continue;
    const auto k = static_cast<std::size_t>(found - block->points.begin());
    const std::uint8_t level = level_of(leaf, *block, k);
    if (selection_.selects(leaf, level, p.x, p.y))
      return SelectedVertex{*found, block->sources[k], level, block->theme(k)};
  }
  return std::nullopt;
}

}  // namespace itin
