#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <itin/contour_lines.hpp>
#include <itin/precondition.hpp>

namespace itin {

namespace {

/// The sides of a square of four centres.
enum Side : std::uint8_t { kNorth, kEast, kSouth, kWest };

struct Piece {
  Side from, to;
};

/// Returns the pieces through a square, by the corners above the level as bits: NW 1, NE 2, SE 4, SW 8. Places above
/// the level lie on the left of the pieces. In the two saddles the square's middle decides which corners are connected.
std::vector<Piece> pieces(unsigned above, bool middle_above) {
  switch (above) {
    case 1:
      return {{kWest, kNorth}};
    case 2:
      return {{kNorth, kEast}};
    case 3:
      return {{kWest, kEast}};
    case 4:
      return {{kEast, kSouth}};
    case 5:
      if (middle_above) return {{kEast, kNorth}, {kWest, kSouth}};
      return {{kWest, kNorth}, {kEast, kSouth}};
    case 6:
      return {{kNorth, kSouth}};
    case 7:
      return {{kWest, kSouth}};
    case 8:
      return {{kSouth, kWest}};
    case 9:
      return {{kSouth, kNorth}};
    case 10:
      if (middle_above) return {{kNorth, kWest}, {kSouth, kEast}};
      return {{kNorth, kEast}, {kSouth, kWest}};
    case 11:
      return {{kSouth, kEast}};
    case 12:
      return {{kEast, kWest}};
    case 13:
      return {{kEast, kNorth}};
    case 14:
      return {{kNorth, kWest}};
    default:
      return {};
  }
}

/// Joins pieces into lines. An edge between two centres has a number; a line enters it once and leaves it once.
class Contour {
 public:
  Contour(const RasterGrid& grid, std::span<const float> values, double level)
      : grid_(grid), values_(values), level_(level) {
    for (std::int64_t row = 0; row + 1 < grid.rows(); ++row)
      for (std::int64_t column = 0; column + 1 < grid.columns(); ++column) cross({column, row});
  }

  std::vector<std::vector<Point2>> lines() {
    // Open lines are followed from their beginnings, then the rest: closed lines.
    for (const std::uint64_t edge : order_)
      if (!entered_.contains(edge)) follow(edge);
    for (const std::uint64_t edge : order_) follow(edge);
    return std::move(lines_);
  }

 private:
  void cross(RasterGrid::Cell nw) {
    const std::array<double, 4> z{value(nw), value({nw.column + 1, nw.row}), value({nw.column + 1, nw.row + 1}),
                                  value({nw.column, nw.row + 1})};
    unsigned above = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (std::isnan(z[i])) return;
      if (z[i] >= level_) above |= 1U << i;
    }
    if (above == 0 || above == 15) return;
    for (const Piece& piece : pieces(above, (z[0] + z[1] + z[2] + z[3]) / 4 >= level_)) {
      const std::uint64_t from = edge(nw, piece.from), to = edge(nw, piece.to);
      next_.emplace(from, to);
      entered_.emplace(to, from);
      order_.push_back(from);
    }
  }

  void follow(std::uint64_t edge) {
    auto step = next_.find(edge);
    if (step == next_.end()) return;
    std::vector<Point2>& line = lines_.emplace_back(1, point(edge));
    for (; step != next_.end(); step = next_.find(edge)) {
      edge = step->second;
      next_.erase(step);
      line.push_back(point(edge));
    }
  }

  double value(RasterGrid::Cell cell) const { return values_[grid_.index(cell)]; }

  /// Returns an edge's number: twice the index of its north-western centre, and one more for an edge that runs
  /// southwards.
  std::uint64_t edge(RasterGrid::Cell nw, Side side) const {
    if (side == kEast) ++nw.column;
    if (side == kSouth) ++nw.row;
    return 2 * grid_.index(nw) + (side == kEast || side == kWest ? 1 : 0);
  }

  Point2 point(std::uint64_t edge) const {
    const auto index = static_cast<std::int64_t>(edge / 2);
    const RasterGrid::Cell a{index % grid_.columns(), index / grid_.columns()};
    const RasterGrid::Cell b =
        edge % 2 == 0 ? RasterGrid::Cell{a.column + 1, a.row} : RasterGrid::Cell{a.column, a.row + 1};
    const double share = (level_ - value(a)) / (value(b) - value(a));
    const Point2 p = grid_.centre(a.column, a.row), q = grid_.centre(b.column, b.row);
    return {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
  }

  const RasterGrid& grid_;
  std::span<const float> values_;
  double level_;
  std::unordered_map<std::uint64_t, std::uint64_t> next_, entered_;
  std::vector<std::uint64_t> order_;
  std::vector<std::vector<Point2>> lines_;
};

}  // namespace

std::vector<std::vector<Point2>> contour_lines(const RasterGrid& grid, std::span<const float> values, double level) {
  ITIN_PRECONDITION(values.size() == grid.cell_count());
  return Contour(grid, values, level).lines();
}

}  // namespace itin
