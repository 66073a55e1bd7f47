#include "features/plan/polygon_sides.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "features/plan/hot_pixel.hpp"

namespace itin {

namespace {

/// +1 where p lies left of the line from a to b, 0 on it, -1 right of it.
template <class Place>
int side_of_line(const Place& a, const Place& b, const Place& p) {
  const Int128 area = Int128{b.x - a.x} * (p.y - a.y) - Int128{b.y - a.y} * (p.x - a.x);
  return (area > 0) - (area < 0);
}

/// Whether p, or else what lies next to it to the right, is right of an edge that crosses its height.
template <class Place>
bool right_of(Place a, Place b, const Place& p) {
  if (b.y < a.y) std::swap(a, b);
  return side_of_line(a, b, p) <= 0;
}

/// Whether p is above an edge that passes over or under what lies next to it to the right.
template <class Place>
bool above(Place a, Place b, const Place& p) {
  if (b.x < a.x) std::swap(a, b);
  const int side = side_of_line(a, b, p);
  return side > 0 || (side == 0 && b.y <= a.y);
}

std::vector<GridEdge> edges_of(const GridPolygon& polygon) {
  std::vector<GridEdge> edges;
  for_each_edge(polygon, [&](Position a, Position b) { edges.emplace_back(a, b); });
  return edges;
}

double length(const GridEdge& e) {
  return std::hypot(double{1} * e.second.x - e.first.x, double{1} * e.second.y - e.first.y);
}

}  // namespace

PolygonSides::PolygonSides(const GridPolygon& polygon) : PolygonSides(edges_of(polygon)) {}

PolygonSides::PolygonSides(std::vector<GridEdge> edges) : edges_(std::move(edges)) {
  GridBox box;
  for (const auto& [a, b] : edges_) box.extend(a.x, a.y);
  if (edges_.empty()) return;
  choose_cells(box);
  fill_cells();
  find_references();
}

/// Chooses the cells: about as many as edges, and on average few for an edge.
void PolygonSides::choose_cells(const GridBox& box) {
  origin_ = {box.xmin, box.ymin};
  extent_ = place({box.xmax, box.ymax});
  double sum = 0;
  for (const GridEdge& e : edges_) sum += length(e);
  const double width = double{1} * box.xmax - box.xmin, height = double{1} * box.ymax - box.ymin;
  const auto count = static_cast<double>(edges_.size());
  const double side = edges_.size() <= 8 ? std::max(width, height) + 1
                                         : std::max({1.0, std::sqrt(2 * width * height / count), sum / (2 * count),
                                                     std::max(width, height) / (count + 1)});
  side_ = static_cast<std::int64_t>(std::ceil(side)) * kScale;
  columns_ = extent_.x / side_ + 1;
  rows_ = extent_.y / side_ + 1;
}

PolygonSides::Place PolygonSides::place(Position p) const {
  return {(std::int64_t{p.x} - origin_.x) * kScale, (std::int64_t{p.y} - origin_.y) * kScale};
}

/// The coordinate of a cell's reference place. It is odd, unlike the coordinates of vertices and of the middles between
/// them.
std::int64_t PolygonSides::reference(std::int64_t cell) const {
  return cell * side_ + side_ / 2 + 1;
}

bool PolygonSides::in_box(const Place& p) const {
  return p.x >= 0 && p.y >= 0 && p.x <= extent_.x && p.y <= extent_.y;
}

std::size_t PolygonSides::cell_of(const Place& p) const {
  return static_cast<std::size_t>(p.y / side_ * columns_ + p.x / side_);
}

template <class Visit>
void PolygonSides::for_each_cell(Point2 p, Point2 q, const Visit& visit) const {
  if (q.y < p.y) std::swap(p, q);
  const double side = static_cast<double>(side_) / static_cast<double>(kScale);
  const auto cell = [&](double v, std::int64_t count) {
    return std::clamp(static_cast<std::int64_t>(std::floor(v / side)), std::int64_t{0}, count - 1);
  };
  const Point2 a{p.x - origin_.x, p.y - origin_.y}, b{q.x - origin_.x, q.y - origin_.y};
  const auto [left, right] = std::minmax(a.x, b.x);
  const std::int64_t last = cell(b.y + 1, rows_);
  for (std::int64_t row = cell(a.y - 1, rows_); row <= last; ++row) {
    // The columns are those that the segment's part in the row meets, with a step to spare.
    const auto along = [&](double y) { return b.y > a.y ? std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : 0.0; };
    double from = left, to = right;
    if (b.y > a.y) {
      const double s = along(static_cast<double>(row) * side - 1), t = along(static_cast<double>(row + 1) * side + 1);
      std::tie(from, to) = std::minmax({a.x + s * (b.x - a.x), a.x + t * (b.x - a.x)});
    }
    const std::int64_t end = cell(to + 1, columns_);
    for (std::int64_t column = cell(from - 1, columns_); column <= end; ++column)
      visit(static_cast<std::size_t>(row * columns_ + column));
  }
}

void PolygonSides::fill_cells() {
  edges_of_cell_ = {static_cast<std::size_t>(columns_ * rows_), edges_.size(), [&](std::uint32_t i, const auto& add) {
                      stop_if_asked();
                      const auto& [a, b] = edges_[i];
                      for_each_cell({double{1} * a.x, double{1} * a.y}, {double{1} * b.x, double{1} * b.y}, add);
                    }};
}

/// Finds the references that are inside, row by row: every edge that crosses the height of a row's references swaps
/// inside and outside to its right.
void PolygonSides::find_references() {
  inside_.assign(static_cast<std::size_t>(columns_ * rows_), false);
  for (const GridEdge& e : edges_) {
    stop_if_asked();
    const Place a = place(e.first), b = place(e.second);
    const auto [low, high] = std::minmax(a.y, b.y);
    for (std::int64_t row = low / side_; row <= high / side_; ++row) {
      const std::int64_t y = reference(row);
      if ((a.y > y) == (b.y > y)) continue;
      const double x = static_cast<double>(a.x) +
                       static_cast<double>(y - a.y) / static_cast<double>(b.y - a.y) * static_cast<double>(b.x - a.x);
      auto column = std::clamp(static_cast<std::int64_t>(x / static_cast<double>(side_)), std::int64_t{0}, columns_);
      while (column > 0 && right_of(a, b, Place{reference(column - 1), y})) --column;
      while (column < columns_ && !right_of(a, b, Place{reference(column), y})) ++column;
      if (column == columns_) continue;
      const auto at = static_cast<std::size_t>(row * columns_ + column);
      inside_[at] = !inside_[at];
    }
  }
  for (std::size_t i = 0; i < inside_.size(); ++i)
    if (i % static_cast<std::size_t>(columns_) != 0) inside_[i] = inside_[i] != inside_[i - 1];
}

/// Walks from the cell's reference along its row to what lies next to p's column to the right, and from there to p.
bool PolygonSides::encloses(const Place& p) const {
  if (!in_box(p)) return false;
  const std::size_t cell = cell_of(p);
  const Place from{reference(p.x / side_), reference(p.y / side_)}, corner{p.x, from.y};
  bool inside = inside_[cell];
  for (const std::uint32_t e : edges_of_cell_.in(cell)) {
    const Place a = place(edges_[e].first), b = place(edges_[e].second);
    if ((a.y > from.y) != (b.y > from.y)) inside ^= right_of(a, b, from) != right_of(a, b, corner);
    if ((a.x > p.x) != (b.x > p.x)) inside ^= above(a, b, corner) != above(a, b, p);
  }
  return inside;
}

bool PolygonSides::encloses_middle(Position a, Position b) const {
  const Place p = place(a), q = place(b);
  return encloses(Place{(p.x + q.x) / 2, (p.y + q.y) / 2});
}

bool PolygonSides::encloses(Point2 p) const {
  const auto scaled = [](double v) { return static_cast<std::int64_t>(std::llround(v * static_cast<double>(kScale))); };
  return encloses(Place{scaled(p.x - origin_.x), scaled(p.y - origin_.y)});
}

Side PolygonSides::at(Position p) const {
  const Place at = place(p);
  if (!in_box(at)) return Side::outside;
  const auto near = edges_of_cell_.in(cell_of(at));
  const auto holds = [&](std::uint32_t e) { return on_segment(edges_[e].first, edges_[e].second, p); };
  if (std::any_of(near.begin(), near.end(), holds)) return Side::border;
  return encloses(at) ? Side::inside : Side::outside;
}

std::vector<std::pair<Point2, Point2>> PolygonSides::inside_parts(Point2 p, Point2 q) const {
  std::vector<std::uint32_t> near;
  if (!edges_.empty()) {
    for_each_cell(p, q, [&](std::size_t cell) {
      const auto of_cell = edges_of_cell_.in(cell);
      near.insert(near.end(), of_cell.begin(), of_cell.end());
    });
  }
  sort_unique(near);
  const double dx = q.x - p.x, dy = q.y - p.y;
  std::vector<double> cuts{0, 1};
  for (const std::uint32_t e : near) {
    const auto& [a, b] = edges_[e];
    const double sa = dx * (a.y - p.y) - dy * (a.x - p.x), sb = dx * (b.y - p.y) - dy * (b.x - p.x);
    if ((sa > 0 && sb > 0) || (sa < 0 && sb < 0)) continue;
    const auto cut = [&](double x, double y) {
      const double t = ((x - p.x) * dx + (y - p.y) * dy) / (dx * dx + dy * dy);
      if (t > 0 && t < 1) cuts.push_back(t);
    };
    if (sa == sb) {  // the edge runs along the segment: what is inside may end at either corner
      cut(a.x, a.y), cut(b.x, b.y);
    } else {
      const double s = sa / (sa - sb);
      cut(a.x + s * (double{1} * b.x - a.x), a.y + s * (double{1} * b.y - a.y));
    }
  }
  sort_unique(cuts);
  const auto position = [&](double t) { return Point2{p.x + t * dx, p.y + t * dy}; };
  std::vector<std::pair<Point2, Point2>> parts;
  for (std::size_t i = 1; i < cuts.size(); ++i)
    if (encloses(position((cuts[i - 1] + cuts[i]) / 2))) parts.emplace_back(position(cuts[i - 1]), position(cuts[i]));
  return parts;
}

}  // namespace itin
