#include "triangulate/region/grid_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace itin {

namespace {

// Rings are cut off here. Data lie strictly inside, so that edges along the cut meet none. One step beyond the grid,
// differences still fit in 31 bits and doubled areas in 63.
constexpr std::int32_t kCut = kGridHalfSide + 1;
constexpr GridBox kWholeGrid{-kGridHalfSide, -kGridHalfSide, kGridHalfSide - 1, kGridHalfSide - 1};

/// Returns the part of a ring where sign * coordinate <= kCut, in grid units (Sutherland and Hodgman). Winding numbers
/// inside the half plane are unchanged.
Window::Ring cut(const Window::Ring& ring, double Point2::*axis, double sign) {
  Window::Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2& p = ring[i];
    const Point2& q = ring[(i + 1) % ring.size()];
    const double over_p = sign * p.*axis - kCut, over_q = sign * q.*axis - kCut;
    if (over_p <= 0) kept.push_back(p);
    if ((over_p < 0 && over_q > 0) || (over_p > 0 && over_q < 0)) {
      const double t = over_p / (over_p - over_q);
      Point2 crossing{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
      crossing.*axis = sign * kCut;
      kept.push_back(crossing);
    }
  }
  return kept;
}

}  // namespace

GridBox GridWindow::Edge::box() const {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
}

/// A convex figure. Figures are tested for being disjoint by the separating axis theorem: boxes first, then the
/// direction of every edge. This is exact, and right for degenerate figures, too (their boxes tell parallel collinear
/// ones apart).
class GridWindow::Figure {
 public:
  explicit Figure(const GridBox& b)
      : corners_{{{b.xmin, b.ymin}, {b.xmax, b.ymin}, {b.xmax, b.ymax}, {b.xmin, b.ymax}}}, size_(4), box_(b) {}
  Figure(const GridPoint& a, const GridPoint& b, const GridPoint& c)
      : corners_{{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}, {}}}, size_(3) {
    for (const Position& p : corners()) box_.extend(p.x, p.y);
  }

  std::span<const Position> corners() const { return {corners_.data(), size_}; }
  const GridBox& box() const { return box_; }

  bool meets(const Edge& edge) const {
    if (!box_.meets(edge.box()) || separated_along(edge.a, edge.b, corners(), {})) return false;
    return size_ == 4 || !separated_by_own_edge(std::array{edge.a, edge.b});
  }
  bool meets(const Figure& box) const { return box_.meets(box.box_) && !separated_by_own_edge(box.corners()); }

 private:
  /// Tells whether the line through a and b, or one parallel to it, has `own` and a on one side and `others` on the
  /// other.
  static bool separated_along(Position a, Position b, std::span<const Position> others, std::span<const Position> own) {
    std::int64_t own_low = 0, own_high = 0;
    for (const Position& p : own)
      own_low = std::min(own_low, doubled_area(a, b, p)), own_high = std::max(own_high, doubled_area(a, b, p));
    std::int64_t low = doubled_area(a, b, others[0]), high = low;
    for (const Position& p : others.subspan(1))
      low = std::min(low, doubled_area(a, b, p)), high = std::max(high, doubled_area(a, b, p));
    return low > own_high || high < own_low;
  }
  /// Tells whether an edge of this triangle separates it; the edges of a box have been dealt with by comparing boxes.
  bool separated_by_own_edge(std::span<const Position> others) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (separated_along(corners_[i], corners_[(i + 1) % 3], others, {&corners_[(i + 2) % 3], 1})) return true;
    }
    return false;
  }

  std::array<Position, 4> corners_;
  std::size_t size_;
  GridBox box_;
};

GridWindow::GridWindow(const Window& window, const Grid& grid, const GridBox& data_bounds) {
  if (window.is_all()) {
    extent_ = bounds_ = data_bounds;
    return;
  }
  bool boxes = true;
  for (const Window::Polygon& part : window.parts()) {
    const std::size_t first = edges_.size();
    add_ring(corners_on(grid, part.outer), false);
    boxes = boxes && part.holes.empty() && form_box({edges_.data() + first, edges_.size() - first});
    for (const Window::Ring& hole : part.holes) add_ring(corners_on(grid, hole), true);
  }
  for (const Edge& e : edges_) extent_.extend(e.box());
  bounds_ = intersection(extent_, kWholeGrid);

  if (form_box(edges_)) {
    edges_.clear();
  } else if (!edges_.empty()) {
    if (boxes) edges_ = without_common_borders(edges_);
    index_edges();
  }
}

/// Tells whether the edges are the four sides of a box, of either orientation.
bool GridWindow::form_box(std::span<const Edge> edges) {
  if (edges.size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Edge& e = edges[i];
    const Position next = edges[(i + 1) % 4].a, opposite = edges[(i + 2) % 4].a;
    const bool side = (e.a.x == e.b.x) != (e.a.y == e.b.y);
    if (!side || e.b != next || e.a.x == opposite.x || e.a.y == opposite.y) return false;
  }
  return true;
}

/// Returns the boundary of a union of boxes, and of their overlaps. A border between two boxes side by side is left
/// out, as there is inside on both sides.
std::vector<GridWindow::Edge> GridWindow::without_common_borders(const std::vector<Edge>& edges) {
  struct End {
    bool vertical;
    std::int32_t line, at;
    int change;  ///< edges upwards or to the right less edges back
  };
  std::vector<End> ends;
  for (const Edge& e : edges) {
    const bool vertical = e.a.x == e.b.x;
    const std::int32_t line = vertical ? e.a.x : e.a.y, from = vertical ? e.a.y : e.a.x, to = vertical ? e.b.y : e.b.x;
    const int change = from < to ? 1 : -1;
    ends.push_back({vertical, line, std::min(from, to), change});
    ends.push_back({vertical, line, std::max(from, to), -change});
  }
  const auto place = [](const End& e) { return std::tuple(e.vertical, e.line, e.at); };
  std::sort(ends.begin(), ends.end(), [&](const End& a, const End& b) { return place(a) < place(b); });
  std::vector<Edge> kept;
  int running = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const End &low = ends[i], &high = ends[i + 1];
    running += low.change;  // 0 again at the end of each line
    if (running == 0 || low.at == high.at) continue;
    const Position p = low.vertical ? Position{low.line, low.at} : Position{low.at, low.line};
    const Position q = low.vertical ? Position{low.line, high.at} : Position{high.at, low.line};
    kept.insert(kept.end(), static_cast<std::size_t>(std::abs(running)), running > 0 ? Edge{p, q} : Edge{q, p});
  }
  return kept;
}

std::vector<Position> GridWindow::corners_on(const Grid& grid, const Window::Ring& ring) {
  Window::Ring scaled;
  bool outside = false;
  for (const Point2& p : ring) {
    scaled.push_back({(p.x - grid.origin.x) / grid.resolution, (p.y - grid.origin.y) / grid.resolution});
    outside = outside || std::abs(scaled.back().x) > kCut || std::abs(scaled.back().y) > kCut;
  }
  if (outside) {
    for (const auto axis : {&Point2::x, &Point2::y})
      for (const double sign : {1.0, -1.0}) scaled = cut(scaled, axis, sign);
  }
  std::vector<Position> corners;
  for (const Point2& p : scaled) {
    const Position corner{static_cast<std::int32_t>(std::llround(p.x)), static_cast<std::int32_t>(std::llround(p.y))};
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

void GridWindow::add_ring(std::vector<Position> corners, bool hole) {
  // The sum is unsigned: for a ring with many turns it may pass through values beyond 64 bits, though its end does not.
  std::uint64_t twice_area = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    twice_area += static_cast<std::uint64_t>(doubled_area(corners[0], corners[i], corners[i + 1]));
  if ((static_cast<std::int64_t>(twice_area) < 0) != hole) std::reverse(corners.begin(), corners.end());
  for (std::size_t i = 0; i < corners.size(); ++i) edges_.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

void GridWindow::index_edges() {
  choose_cells();
  edges_by_cell_ = {std::size_t{columns_} * rows_, edges_.size(),
                    [this](std::uint32_t e, const auto& add) { visit_cells(edges_[e], add); }};
  edges_by_row_ = {rows_, edges_.size(), [this](std::uint32_t e, const auto& add) {
                     const CellRange range = cells(edges_[e].box());
                     for (std::uint32_t row = range.row0; row <= range.row1; ++row) add(row);
                   }};
  classify_cells();
}

void GridWindow::choose_cells() {
  // In cells that the boundary meets, each triangle is tested. Cells are small, so that few triangles lie there; the
  // limits bound the index to a few MB.
  const std::size_t limit = std::clamp<std::size_t>(128 * edges_.size(), 256, std::size_t{1} << 20);
  const std::uint32_t width = static_cast<std::uint32_t>(extent_.xmax - extent_.xmin);
  const std::uint32_t height = static_cast<std::uint32_t>(extent_.ymax - extent_.ymin);
  while (std::size_t{(width >> log2_cell_) + 1} * ((height >> log2_cell_) + 1) > limit) ++log2_cell_;
  columns_ = (width >> log2_cell_) + 1;
  rows_ = (height >> log2_cell_) + 1;
}

GridBox GridWindow::cell_box(std::uint32_t column, std::uint32_t row) const {
  // Neighbours share their border, as edges also run between grid positions. The last column may reach beyond the
  // extent.
  const std::int64_t side = std::int64_t{1} << log2_cell_;
  const std::int64_t x = extent_.xmin + column * side, y = extent_.ymin + row * side;
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
          static_cast<std::int32_t>(std::min<std::int64_t>(x + side, kCut)),
          static_cast<std::int32_t>(std::min<std::int64_t>(y + side, kCut))};
}

/// Returns the cells of the positions of a box that meets the extent.
GridWindow::CellRange GridWindow::cells(const GridBox& box) const {
  const GridBox b = intersection(box, extent_);
  const auto index = [this](std::int32_t v, std::int32_t low) {
    return (static_cast<std::uint32_t>(v) - static_cast<std::uint32_t>(low)) >> log2_cell_;
  };
  return {index(b.xmin, extent_.xmin), index(b.xmax, extent_.xmin), index(b.ymin, extent_.ymin),
          index(b.ymax, extent_.ymin)};
}

/// Visits every cell that the edge meets; as for positions, a border belongs to the cell after it.
template <typename Visit>
void GridWindow::visit_cells(const Edge& edge, const Visit& visit) const {
  const GridBox box = edge.box();
  const CellRange range = cells(box);
  const double slope = edge.a.y == edge.b.y ? 0 : (double{1} * edge.b.x - edge.a.x) / (double{1} * edge.b.y - edge.a.y);
  for (std::uint32_t row = range.row0; row <= range.row1; ++row) {
    CellRange span = range;
    if (slope != 0) {
      const GridBox strip = cell_box(0, row);
      const double x0 = edge.a.x + (std::max(strip.ymin, box.ymin) - double{1} * edge.a.y) * slope;
      const double x1 = edge.a.x + (std::min(strip.ymax, box.ymax) - double{1} * edge.a.y) * slope;
      // Two steps of slack absorb the rounding; the exact test below decides.
      GridBox part = box;
      part.xmin = std::max(box.xmin, static_cast<std::int32_t>(std::floor(std::min(x0, x1))) - 2);
      part.xmax = std::min(box.xmax, static_cast<std::int32_t>(std::ceil(std::max(x0, x1))) + 2);
      span = cells(part);
    }
    for (std::uint32_t column = span.column0; column <= span.column1; ++column) {
      if (Figure(cell_box(column, row)).meets(edge)) visit(cell(column, row));
    }
  }
}

void GridWindow::classify_cells() {
  states_.assign(std::size_t{columns_} * rows_, State::Mixed);
  for (std::uint32_t row = 0; row < rows_; ++row) {
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const std::size_t c = cell(column, row);
      if (!edges_by_cell_.in(c).empty()) continue;
      // No edge meets the border shared with an unmixed neighbour, so both are on one side.
      if (column > 0 && states_[c - 1] != State::Mixed) {
        states_[c] = states_[c - 1];
      } else {
        const GridBox box = cell_box(column, row);
        states_[c] = wound(box.xmin, box.ymin) ? State::Inside : State::Outside;
      }
    }
  }
}

/// Tells whether the position, within the extent, is inside or on a ring.
bool GridWindow::wound(std::int32_t x, std::int32_t y) const {
  const std::uint32_t row = cells({x, y, x, y}).row0;
  const Position p{x, y};
  int winding = 0;
  for (const std::uint32_t e : edges_by_row_.in(row)) {
    const Edge& edge = edges_[e];
    const bool upward = edge.a.y <= y && y < edge.b.y, downward = edge.b.y <= y && y < edge.a.y;
    const bool beside = edge.box().contains(x, y);
    if (!upward && !downward && !beside) continue;
    const std::int64_t side = doubled_area(edge.a, edge.b, p);
    if (side == 0 && beside) return true;
    if (upward && side > 0) ++winding;
    if (downward && side < 0) --winding;
  }
  return winding > 0;
}

bool GridWindow::contains(std::int32_t x, std::int32_t y) const {
  if (!extent_.contains(x, y)) return false;
  if (is_box()) return true;
  const CellRange range = cells({x, y, x, y});
  const State state = states_[cell(range.column0, range.row0)];
  return state == State::Mixed ? wound(x, y) : state == State::Inside;
}

bool GridWindow::boundary_meets(const Figure& figure, const CellRange& range) const {
  if (range.count() > edges_.size())
    return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& e) { return figure.meets(e); });
  for (std::uint32_t row = range.row0; row <= range.row1; ++row) {
    for (std::uint32_t column = range.column0; column <= range.column1; ++column) {
      for (const std::uint32_t e : edges_by_cell_.in(cell(column, row))) {
        if (figure.meets(edges_[e])) return true;
      }
    }
  }
  return false;
}

bool GridWindow::holds(const GridBox& box) const {
  if (!extent_.contains(box)) return false;
  if (is_box()) return true;
  // The reason is as in meets().
  return contains(box.xmin, box.ymin) && !boundary_meets(Figure(box), cells(box));
}

bool GridWindow::meets(const GridBox& box) const {
  if (box.empty() || !extent_.meets(box)) return false;
  if (is_box()) return true;
  // A figure that no ring meets is on one side as a whole; one of its positions decides.
  const GridBox part = intersection(box, extent_);
  return contains(part.xmin, part.ymin) || boundary_meets(Figure(part), cells(part));
}

bool GridWindow::meets(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
  const Figure figure(a, b, c);
  if (!extent_.meets(figure.box())) return false;
  if (is_box()) {
    return extent_.contains(a.x, a.y) || extent_.contains(b.x, b.y) || extent_.contains(c.x, c.y) ||
           figure.meets(Figure(extent_));
  }
  const CellRange range = cells(figure.box());
  if (range.count() == 1) {
    // A cell at the rim of the extent is never Inside, so a cell that is Inside holds the whole triangle.
    const State state = states_[cell(range.column0, range.row0)];
    if (state != State::Mixed) return state == State::Inside;
  }
  return contains(a.x, a.y) || boundary_meets(figure, range);
}

}  // namespace itin
