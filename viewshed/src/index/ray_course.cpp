#include "index/ray_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/precondition.hpp>

namespace itin::viewshed {

namespace {

/// Edges that are crossed closer to each other than this, in cells, are crossed at one place: the post where they meet.
constexpr double kOnePlace = 1e-10;

/// Parallel edges of a lattice, one cell apart, as a ray crosses them one after the other. Its `at` is the distance of
/// the next, in cells along the ray.
class ParallelEdges {
 public:
  /// The ray begins at `from` and gains `slope` with each cell of its length; edges are at whole numbers.
  ParallelEdges(double from, double slope) : from_(from), slope_(slope) {
    number_ = slope > 0 ? std::floor(from) + 1 : std::ceil(from) - 1;
    measure();
  }

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

/// An edge and where it is crossed.
struct CrossedEdge {
  std::int64_t column = 0, row = 0;        ///< its first end
  std::int64_t to_column = 0, to_row = 0;  ///< its second end
  double weight = 0;
};

}  // namespace

RayCourse::RayCourse(const RayFan& fan, double azimuth, const PostRows& posts) : fan_(fan) {
  // Columns count eastwards and rows southwards; the diagonals of cells run from north-west to south-east.
  const double u = std::sin(azimuth), v = -std::cos(azimuth);
  ITIN_PRECONDITION(u != 0 && v != 0 && u != v);
  ParallelEdges columns(fan.east, u), rows(fan.south, v), diagonals(fan.south - fan.east, v - u);
  const auto x = [&](double at) { return fan.east + at * u; };
  const auto y = [&](double at) { return fan.south + at * v; };
  const auto floored = [](double value) { return static_cast<std::int64_t>(std::floor(value)); };
  const auto cross_next = [&](double at) {
    CrossedEdge edge;
    if (columns.at() == at) {
      edge.column = edge.to_column = columns.number(), edge.row = floored(y(at)), edge.to_row = edge.row + 1;
      edge.weight = y(at) - static_cast<double>(edge.row);
      columns.advance();
    } else if (rows.at() == at) {
      edge.row = edge.to_row = rows.number(), edge.column = floored(x(at)), edge.to_column = edge.column + 1;
      edge.weight = x(at) - static_cast<double>(edge.column);
      rows.advance();
    } else {
      edge.column = floored(x(at)), edge.row = edge.column + diagonals.number();
      edge.to_column = edge.column + 1, edge.to_row = edge.row + 1;
      edge.weight = x(at) - static_cast<double>(edge.column);
      diagonals.advance();
    }
    return edge;
  };
  const double width = fan.ring_width();
  const auto look_at = [&](std::uint32_t ring) { return (ring + 0.5) * width; };
  double before = 0;  // cells
  box_ = {0, 0, 1, 1};
  for (std::uint32_t ring = 0; ring < fan.rings && look_at(ring) <= fan.reach;) {
    const double at = std::min({columns.at(), rows.at(), diagonals.at()});
    const CrossedEdge edge = cross_next(at);
    if (at - before < kOnePlace) continue;
    const double middle = (before + at) / 2;
    const std::int64_t column = floored(x(middle)), row = floored(y(middle));
    RayStep step{};
    step.first = posts.offset(edge.column, edge.row), step.second = posts.offset(edge.to_column, edge.to_row);
    step.cell = posts.offset(column, row);
    step.weight = edge.weight;
    step.distance = at * fan.spacing, step.per_distance = 1 / step.distance;
    step.drop = fan.drop * step.distance * step.distance;
    step.before = before * fan.spacing;
    step.drop_before = fan.drop * step.before * step.before;
    step.ratio = before / (at - before);
    step.half = y(middle) - static_cast<double>(row) > x(middle) - static_cast<double>(column) ? LatticeTin::kSouthWest
                                                                                               : LatticeTin::kNorthEast;
    for (; ring < fan.rings && look_at(ring) <= fan.reach && look_at(ring) <= step.distance; ++ring, ++step.looks) {
      const double distance = look_at(ring);
      looks_.push_back({distance, 1 / distance, fan.drop * distance * distance,
                        (distance - step.before) / (step.distance - step.before), 2.0 * ring + 1});
      weight_ += looks_.back().weight;
    }
    steps_.push_back(step);
    const auto in_cell = [&](double place) {
      return Point2{x(place) - static_cast<double>(column), y(place) - static_cast<double>(row)};
    };
    const Point2 from = in_cell(before), to = in_cell(at);
    crossings_.push_back({column, row, from.x, from.y, to.x, to.y});
    box_.west = std::min({box_.west, edge.column, column}),
    box_.east = std::max({box_.east, edge.to_column, column + 1});
    box_.north = std::min({box_.north, edge.row, row}), box_.south = std::max({box_.south, edge.to_row, row + 1});
    before = at;
  }
}

}  // namespace itin::viewshed
