#include "index/ray_course.hpp"

#include <algorithm>
#include <cmath>

#include <itin/precondition.hpp>

namespace itin::viewshed {

namespace {

/// Edges that are crossed closer to each other than this, in cells, are crossed at one place: the post where they meet.
constexpr double kOnePlace = 1e-10;
constexpr std::size_t kStepsOfBlock = 16;

std::int64_t floored(double value) {
  return static_cast<std::int64_t>(std::floor(value));
}

/// Parallel edges of a lattice, one cell apart, as a ray crosses them one after the other.
class ParallelEdges {
 public:
  /// The ray begins at `from` and gains `slope` with each cell of its length; edges are at whole numbers.
  ParallelEdges(double from, double slope) : from_(from), slope_(slope) {
    number_ = slope > 0 ? std::floor(from) + 1 : std::ceil(from) - 1;
    measure();
  }

  /// Returns the distance of the next edge along the ray, cells.
  double at() const { return at_; }
  std::int64_t number() const { return static_cast<std::int64_t>(number_); }
  void advance() {
    number_ += slope_ > 0 ? 1 : -1;
    measure();
  }

 private:
  void measure() { at_ = (number_ - from_) / slope_; }

  double from_, slope_;
  double number_ = 0, at_ = 0;
};

/// All edges that a ray crosses, nearest first. Columns count eastwards and rows southwards; the diagonals of cells run
/// from north-west to south-east.
class CrossedEdges {
 public:
  struct Edge {
    double at = 0;  ///< along the ray, cells
    std::int64_t column = 0, row = 0;
    std::int64_t to_column = 0, to_row = 0;
    double weight = 0;  ///< how near to the second end
  };

  CrossedEdges(const RayFan& fan, double azimuth)
      : from_{fan.east, fan.south},
        u_(std::sin(azimuth)),
        v_(-std::cos(azimuth)),
        columns_(from_.x, u_),
        rows_(from_.y, v_),
        diagonals_(from_.y - from_.x, v_ - u_) {
    ITIN_PRECONDITION(u_ != 0 && v_ != 0 && u_ != v_);
  }

  /// Returns the place at a distance, as column and row.
  Point2 place(double at) const { return {from_.x + at * u_, from_.y + at * v_}; }

  Edge next() {
    const double at = std::min({columns_.at(), rows_.at(), diagonals_.at()});
    const auto [x, y] = place(at);
    const std::int64_t column = floored(x), row = floored(y);
    const double beyond_column = x - static_cast<double>(column), beyond_row = y - static_cast<double>(row);
    if (columns_.at() == at) {
      const std::int64_t number = columns_.number();
      columns_.advance();
      return {at, number, row, number, row + 1, beyond_row};
    }
    if (rows_.at() == at) {
      const std::int64_t number = rows_.number();
      rows_.advance();
      return {at, column, number, column + 1, number, beyond_column};
    }
    const std::int64_t on_diagonal = column + diagonals_.number();
    diagonals_.advance();
    return {at, column, on_diagonal, column + 1, on_diagonal + 1, beyond_column};
  }

 private:
  Point2 from_;
  double u_, v_;
  ParallelEdges columns_, rows_, diagonals_;
};

}  // namespace

RayCourse::RayCourse(const RayFan& fan, double azimuth, const PostRows& posts, const PostBox& observers) : fan_(fan) {
  CrossedEdges edges(fan, azimuth);
  const auto look_at = [&](std::uint32_t ring) { return (ring + 0.5) * fan.ring_width(); };
  double before = 0;  // cells
  PostBox block{0, 0, 1, 1};
  for (std::uint32_t ring = 0; ring < fan.rings && look_at(ring) <= fan.reach;) {
    const CrossedEdges::Edge edge = edges.next();
    if (edge.at - before < kOnePlace) continue;
    const Point2 middle = edges.place((before + edge.at) / 2), from = edges.place(before), to = edges.place(edge.at);
    const std::int64_t column = floored(middle.x), row = floored(middle.y);
    const auto west = static_cast<double>(column), north = static_cast<double>(row);
    RayStep step{};
    step.first = posts.offset(edge.column, edge.row), step.second = posts.offset(edge.to_column, edge.to_row);
    step.cell = posts.offset(column, row);
    step.weight = edge.weight;
    step.distance = edge.at * fan.spacing, step.per_distance = 1 / step.distance;
    step.drop = fan.drop * step.distance * step.distance;
    step.before = before * fan.spacing;
    step.drop_before = fan.drop * step.before * step.before;
    step.ratio = before / (edge.at - before);
    step.half = middle.y - north > middle.x - west ? LatticeTin::kSouthWest : LatticeTin::kNorthEast;
    for (; ring < fan.rings && look_at(ring) <= fan.reach && look_at(ring) <= step.distance; ++ring, ++step.looks) {
      const double distance = look_at(ring);
      looks_.push_back({distance, 1 / distance, fan.drop * distance * distance,
                        (distance - step.before) / (step.distance - step.before), 2.0 * ring + 1});
      weight_ += looks_.back().weight;
    }
    steps_.push_back(step);
    crossings_.push_back({column, row, from.x - west, from.y - north, to.x - west, to.y - north});
    block.extend({std::min(edge.column, column), std::min(edge.row, row), std::max(edge.to_column, column + 1),
                  std::max(edge.to_row, row + 1)});
    before = edge.at;
    if (steps_.size() % kStepsOfBlock != 0) continue;
    end_block(posts, observers.around(block));
    block = {edge.column, edge.row, edge.to_column, edge.to_row};
  }
  end_block(posts, observers.around(block));
}

/// Makes a block of the steps that are in none yet, which meet these posts.
void RayCourse::end_block(const PostRows& posts, const PostBox& met) {
  const std::size_t first = blocks_.empty() ? 0 : blocks_.back().last_step;
  if (first == steps_.size()) return;
  RayBlock block{.last_step = steps_.size()};
  for (std::size_t s = first; s < steps_.size(); ++s) block.looks += steps_[s].looks;
  const double near = steps_[first].before, far = steps_.back().distance;
  block.nearest = 1 / near, block.farthest = 1 / far;
  block.least_drop = fan_.drop * (fan_.drop > 0 ? near : far);
  block.ceiling = posts.highest(met);
  blocks_.push_back(block);
  whole_ = whole_ && posts.whole(met);
}

}  // namespace itin::viewshed
