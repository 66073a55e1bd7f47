#include "triangulate/apex.hpp"

#include <algorithm>
#include <cmath>

namespace itin {

/// The coordinate frame of one edge, in double precision.
struct ApexSearch::Frame {
  Position a, b;
  double mx, my;  ///< midpoint
  double nx, ny;  ///< unit normal to the left
  double r;       ///< half the length

  Frame(Position from, Position to) : a(from), b(to) {
    const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
    const double length = std::hypot(dx, dy);
    mx = a.x + dx / 2, my = a.y + dy / 2;
    nx = -dy / length, ny = dx / length;
    r = length / 2;
  }

  double height(double x, double y) const { return (x - mx) * nx + (y - my) * ny; }

  /// (c - a) . (c - b) = |c - m|^2 - r^2 and twice the area of abc are exact, so nothing cancels in lambda.
  double lambda(Position c) const {
    const double dot = static_cast<double>((std::int64_t{c.x} - a.x) * (std::int64_t{c.x} - b.x) +
                                           (std::int64_t{c.y} - a.y) * (std::int64_t{c.y} - b.y));
    return dot * r / static_cast<double>(doubled_area(a, b, c));
  }

  /// Whether (x, y) may lie inside or on the circle lambda: surely false only when it does not. A distant centre
  /// cancels nothing, as |p - centre|^2 - radius^2 is taken relative to m.
  bool inside(double lambda, double x, double y) const {
    const double dx = x - mx, dy = y - my, square = dx * dx + dy * dy;
    const double error = 1e-12 * (square + r * r + std::abs(lambda) * (std::abs(dx) + std::abs(dy))) + 1;
    return square - r * r - 2 * lambda * (dx * nx + dy * ny) <= error;
  }

  /// Surely false only when no point of the box is inside or on the circle and left of ab.
  bool cap_meets(double lambda, const GridBox& box) const {
    const double cx = mx + lambda * nx, cy = my + lambda * ny;
    // One unit of slack absorbs the rounding of centre and corners.
    const double x = std::clamp(cx, box.xmin - 1.0, box.xmax + 1.0), y = std::clamp(cy, box.ymin - 1.0, box.ymax + 1.0);
    return inside(lambda, x, y) && left_of(box);
  }

  bool left_of(const GridBox& box) const {
    const double x = nx > 0 ? box.xmax : box.xmin, y = ny > 0 ? box.ymax : box.ymin;
    return height(x, y) > -1;
  }

  /// About the least lambda of the box: an order of visits, not a bound.
  double key(const GridBox& box) const {
    const Position nearest{static_cast<std::int32_t>(std::clamp(mx, double{1} * box.xmin, double{1} * box.xmax)),
                           static_cast<std::int32_t>(std::clamp(my, double{1} * box.ymin, double{1} * box.ymax))};
    double least = std::numeric_limits<double>::infinity();
    for (const Position p : {nearest, Position{box.xmin, box.ymin}, Position{box.xmax, box.ymin},
                             Position{box.xmin, box.ymax}, Position{box.xmax, box.ymax}}) {
      if (orientation(a, b, p) > 0) least = std::min(least, lambda(p));
    }
    return least;
  }

  /// The box of the circle's part left of ab, a little enlarged and cut off at `limit`.
  GridBox cap_box(double lambda, const GridBox& limit) const {
    const double cx = mx + lambda * nx, cy = my + lambda * ny, radius = std::hypot(r, lambda);
    double xmin = std::min(a.x, b.x), xmax = std::max(a.x, b.x);
    double ymin = std::min(a.y, b.y), ymax = std::max(a.y, b.y);
    if (height(cx - radius, cy) >= 0) xmin = std::min(xmin, cx - radius);
    if (height(cx + radius, cy) >= 0) xmax = std::max(xmax, cx + radius);
    if (height(cx, cy - radius) >= 0) ymin = std::min(ymin, cy - radius);
    if (height(cx, cy + radius) >= 0) ymax = std::max(ymax, cy + radius);
    const double slack = 2 + 1e-9 * radius;
    const auto cut = [](double v, std::int32_t low, std::int32_t high) {
      return static_cast<std::int32_t>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
    };
    return {cut(std::floor(xmin - slack), limit.xmin, limit.xmax),
            cut(std::floor(ymin - slack), limit.ymin, limit.ymax), cut(std::ceil(xmax + slack), limit.xmin, limit.xmax),
            cut(std::ceil(ymax + slack), limit.ymin, limit.ymax)};
  }
};

bool crosses(const Segment& s, Position p, Position q) {
  const Position a{s.ax, s.ay}, b{s.bx, s.by};
  return orientation(p, q, a) * orientation(p, q, b) < 0 && orientation(a, b, p) * orientation(a, b, q) < 0;
}

std::uint8_t ApexSearch::level_of(const Leaf& leaf, const Block& block, std::size_t k) const {
  return block.levels.empty() ? static_cast<std::uint8_t>(leaf.level) : block.levels[k];
}

std::shared_ptr<const Block> ApexSearch::read(const Leaf& leaf) {
  std::shared_ptr<const Block>& block = blocks_[leaf.key];
  if (block == nullptr) {
    block = index_.block(leaf);
    statistics_.points_read += block->points.size();
    statistics_.blocks_read += 1;
  }
  return block;
}

std::optional<SelectedVertex> ApexSearch::nearest_circle(const Frame& frame, double lambda, const Position* beyond) {
  const GridBox box = frame.cap_box(lambda, index_.bounds());
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  std::erase_if(leaves_, [&](const Leaf& leaf) { return !frame.cap_meets(lambda, leaf.cell.box()); });
  if (leaves_.empty()) return std::nullopt;
  segments_.clear();
  index_.segments(box, segments_);
  std::erase_if(segments_, [&](const Segment& s) { return !selection_.selects(s); });
  std::vector<std::pair<double, std::uint32_t>> order(leaves_.size());
  for (std::uint32_t i = 0; i < leaves_.size(); ++i) order[i] = {frame.key(leaves_[i].cell.box()), i};
  std::sort(order.begin(), order.end());

  const Position a = frame.a, b = frame.b;
  const auto hidden = [&](Position c) {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const Segment& s) { return crosses(s, a, c) || crosses(s, b, c); });
  };
  std::optional<SelectedVertex> best;
  double reach = lambda;
  for (const auto& [key, i] : order) {
    const Leaf& leaf = leaves_[i];
    if (!frame.cap_meets(reach, leaf.cell.box())) continue;
    const auto block = read(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& point = block->points[k];
      const Position c{point.x, point.y};
      // Segments are known only for this box; what lies outside comes with a larger one.
      if (!box.contains(c.x, c.y) || !frame.inside(reach, c.x, c.y) || orientation(a, b, c) <= 0) continue;
      const std::uint8_t level = level_of(leaf, *block, k);
      if (!selection_.selects(level, c.x, c.y)) continue;
      if (best ? in_circle_perturbed(a, b, best->position(), c) < 0
               : beyond != nullptr && in_circle_perturbed(b, a, *beyond, c) < 0) {
        continue;
      }
      if (hidden(c)) continue;
      best = SelectedVertex{point, block->sources[k], level};
      reach = std::min(reach, frame.lambda(c));
    }
  }
  return best;
}

std::optional<SelectedVertex> ApexSearch::intruder(Position a, Position b, Position c) {
  const Frame frame(a, b);
  return nearest_circle(frame, frame.lambda(c), &c);
}

std::optional<SelectedVertex> ApexSearch::apex(Position a, Position b) {
  const GridBox all = index_.bounds();
  // The edges along the border of a raster are many.
  const Position farthest{b.y > a.y ? all.xmin : all.xmax, b.x > a.x ? all.ymax : all.ymin};
  if (orientation(a, b, farthest) <= 0) return std::nullopt;
  const Frame frame(a, b);
  const double span =
      frame.r + std::hypot(static_cast<double>(all.xmax) - all.xmin, static_cast<double>(all.ymax) - all.ymin);
  for (double lambda = frame.r; lambda < span; lambda *= 4) {
    const auto best = nearest_circle(frame, lambda, nullptr);
    // What lies on the searched circle itself may have rivals that rounding left out.
    if (best && frame.lambda(best->position()) < 0.999 * lambda) return best;
  }
  // A grid position left of ab is at least 1 / |ab| away from it, so no circle is larger than this.
  return nearest_circle(frame, span * span * (frame.r + 1), nullptr);
}

std::optional<SelectedVertex> ApexSearch::inside(Position a, Position b, Position c) {
  GridBox box;
  for (const Position p : {a, b, c}) box.extend(p.x, p.y);
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  for (const Leaf& leaf : leaves_) {
    const auto block = read(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const Position p{block->points[k].x, block->points[k].y};
      if (!box.contains(p.x, p.y) || p == a || p == b || p == c) continue;
      if (orientation(a, b, p) < 0 || orientation(b, c, p) < 0 || orientation(c, a, p) < 0) continue;
      const std::uint8_t level = level_of(leaf, *block, k);
      if (selection_.selects(level, p.x, p.y)) return SelectedVertex{block->points[k], block->sources[k], level};
    }
  }
  return std::nullopt;
}

std::optional<SelectedVertex> ApexSearch::at(Position p) {
  const GridBox box{p.x, p.y, p.x, p.y};
  leaves_.clear();
  selected_leaves(index_, selection_, box, leaves_);
  for (const Leaf& leaf : leaves_) {
    const auto block = read(leaf);
    const auto found = std::lower_bound(block->points.begin(), block->points.end(), morton(p.x, p.y),
                                        [](const GridPoint& q, std::uint64_t code) { return morton(q.x, q.y) < code; });
    if (found == block->points.end() || found->x != p.x || found->y != p.y) continue;
    const auto k = static_cast<std::size_t>(found - block->points.begin());
    const std::uint8_t level = level_of(leaf, *block, k);
    if (selection_.selects(level, p.x, p.y)) return SelectedVertex{*found, block->sources[k], level};
  }
  return std::nullopt;
}

}  // namespace itin
