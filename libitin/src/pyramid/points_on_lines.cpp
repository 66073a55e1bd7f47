#include "pyramid/points_on_lines.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <itin/sort_unique.hpp>

#include "features/plan/hot_pixel.hpp"
#include "geometry/cell.hpp"
#include "store/segments/edge_quadtree.hpp"

namespace itin {

namespace {

/// Points that are read at once.
constexpr std::uint64_t kPointsRead = 4096;
/// Pairs of a point and a piece that are compared without a look at where they lie.
constexpr std::size_t kFewPairs = 256;

using PieceNumbers = std::vector<std::uint32_t>;

struct LinePiece {
  GridPoint a, b;
};

struct PointOnPiece {
  std::uint32_t piece;
  GridPoint point;  ///< with the piece's height
  /// In order along pieces: by x, then by y.
  friend auto operator<=>(const PointOnPiece&, const PointOnPiece&) = default;
};

/// The height of a piece at a position on it.
std::int32_t height_on(const LinePiece& piece, Position p) {
  const auto& [a, b] = piece;
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const std::int64_t along = dx * (std::int64_t{p.x} - a.x) + dy * (std::int64_t{p.y} - a.y);
  const std::int64_t rise = rounded_quotient(Int128{along} * (std::int64_t{b.z} - a.z), dx * dx + dy * dy);
  return static_cast<std::int32_t>(a.z + rise);
}

/// Finds the points strictly within pieces. Descends the quadtree where there are both pieces and points.
class PointsOnPieces {
 public:
  PointsOnPieces(const std::vector<LinePiece>& pieces, const SortedPoints& points, Progress& progress)
      : pieces_(pieces), points_(points), progress_(progress) {}

  /// The points in order of pieces, and along each.
  std::vector<PointOnPiece> run() {
    PieceNumbers crossing;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i)
      if (has_positions(pieces_[i])) crossing.push_back(i);
    descend(Cell{}, crossing, 0, points_.size());
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  /// Whether there are positions of the grid between the ends.
  static bool has_positions(const LinePiece& piece) {
    return std::gcd(std::int64_t{piece.b.x} - piece.a.x, std::int64_t{piece.b.y} - piece.a.y) > 1;
  }

  PieceNumbers those_in(const Cell& cell, const PieceNumbers& pieces) const {
    PieceNumbers result;
    std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(result), [&](std::uint32_t i) {
      const auto& [a, b] = pieces_[i];
      return crosses(Segment{a.x, a.y, b.x, b.y}, cell);
    });
    return result;
  }

  void descend(const Cell& cell, const PieceNumbers& pieces, std::uint64_t first, std::uint64_t last) {
    if (pieces.empty() || first == last) return;
    if (last - first <= kPointsRead) return read(cell, pieces, first, last);
    for (int i = 0; i < 4; ++i) {
      const Cell child = cell.child(i);
      const std::uint64_t end = i == 3 ? last : points_.lower_bound(child.end());
      if (first != end) descend(child, those_in(child, pieces), first, end);
      first = end;
    }
  }

  void read(const Cell& cell, const PieceNumbers& pieces, std::uint64_t first, std::uint64_t last) {
    progress_.throw_if_cancelled();
    progress_.report("leading lines through points", static_cast<double>(first) / static_cast<double>(points_.size()));
    std::vector<RawPoint> points(last - first);
    points_.read(first, points);
    search(cell, pieces, points);
  }

  void search(const Cell& cell, const PieceNumbers& pieces, std::span<const RawPoint> points) {
    if (pieces.empty()) return;
    if (points.size() * pieces.size() <= kFewPairs || cell.log2_side == 0) return compare(pieces, points);
    for (int i = 0; i < 4; ++i) {
      const Cell child = cell.child(i);
      const auto end = std::lower_bound(points.begin(), points.end(), child.end(),
                                        [](const RawPoint& p, std::uint64_t code) { return p.code < code; });
      const auto count = i == 3 ? points.size() : static_cast<std::size_t>(end - points.begin());
      if (count > 0) search(child, those_in(child, pieces), points.first(count));
      points = points.subspan(count);
    }
  }

  void compare(const PieceNumbers& pieces, std::span<const RawPoint> points) {
    for (const RawPoint& point : points) {
      const Position p = position_of(point.code);
      for (const std::uint32_t i : pieces) {
        const Position a{pieces_[i].a.x, pieces_[i].a.y}, b{pieces_[i].b.x, pieces_[i].b.y};
        if (p != a && p != b && on_segment(a, b, p)) found_.push_back({i, {p.x, p.y, height_on(pieces_[i], p)}});
      }
    }
  }

  const std::vector<LinePiece>& pieces_;
  const SortedPoints& points_;
  Progress& progress_;
  std::vector<PointOnPiece> found_;
};

/// The points on the pieces of those items that are of the terrain, by the number of the item.
template <class Items, class PieceOf>
std::vector<PointOnPiece> points_on(const Items& items, const std::vector<bool>& terrain, const SortedPoints& points,
                                    Progress& progress, const PieceOf& piece_of) {
  std::vector<LinePiece> pieces(items.size(), LinePiece{});  // pieces of others have no length, and no points
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].owner < terrain.size() && terrain[items[i].owner]) pieces[i] = piece_of(items[i]);
  return PointsOnPieces(pieces, points, progress).run();
}

/// Splits the edges of planar lines at points on them; all numbers change.
class EdgeSplit {
 public:
  EdgeSplit(const std::vector<PointOnPiece>& points, PlanarLines& lines) : lines_(lines) {
    // Several owners may share an edge: each of them passes through its points.
    for (const auto& [edge, point] : points) points_.push_back({lines.edges[edge].from, lines.edges[edge].to, point});
    sort_unique(points_);
  }

  void run() {
    const std::vector<GridPoint> before = std::exchange(lines_.vertices, with_points());
    for (const GridPoint& p : before) new_number_.push_back(number_of(p));
    const std::vector<PlanarEdge> edges = std::exchange(lines_.edges, {});
    for (std::uint32_t i = 0; i < edges.size(); ++i) split(edges[i], i);
    std::sort(pieces_.begin(), pieces_.end());
    for (const auto& [piece, edge] : pieces_) lines_.edges.push_back(piece);
    hand_on_features();
  }

 private:
  struct PointOnEdge {
    std::uint32_t from, to;
    GridPoint point;
    friend auto operator<=>(const PointOnEdge&, const PointOnEdge&) = default;
  };

  std::vector<GridPoint> with_points() const {
    std::vector<GridPoint> vertices = lines_.vertices;
    for (const PointOnEdge& p : points_) vertices.push_back(p.point);
    std::sort(vertices.begin(), vertices.end(), before_by_code);
    return vertices;
  }

  std::uint32_t number_of(const GridPoint& p) const {
    return static_cast<std::uint32_t>(find_by_code(lines_.vertices, code_of(p)) - lines_.vertices.begin());
  }

  void split(const PlanarEdge& e, std::uint32_t number) {
    const auto by_edge = [](const PointOnEdge& p, const PointOnEdge& q) {
      return std::pair(p.from, p.to) < std::pair(q.from, q.to);
    };
    const auto [first, last] = std::equal_range(points_.begin(), points_.end(), PointOnEdge{e.from, e.to, {}}, by_edge);
    // Points on an edge are in order of x, then y, and so are the ends here.
    std::uint32_t from = new_number_[e.from], to = new_number_[e.to];
    if (lines_.vertices[to] < lines_.vertices[from]) std::swap(from, to);
    const auto add = [&](std::uint32_t next) {
      pieces_.push_back({{std::min(from, next), std::max(from, next), e.owner}, number});
      from = next;
    };
    for (auto p = first; p != last; ++p) add(number_of(p->point));
    add(to);
  }

  void hand_on_features() {
    const std::vector<EdgeFeature> features = std::exchange(lines_.features, {});
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
      const auto of_edge = std::equal_range(features.begin(), features.end(), EdgeFeature{pieces_[piece].second, 0},
                                            [](const EdgeFeature& f, const EdgeFeature& g) { return f.edge < g.edge; });
      for (auto f = of_edge.first; f != of_edge.second; ++f) lines_.features.push_back({piece, f->feature});
    }
  }

  PlanarLines& lines_;
  std::vector<PointOnEdge> points_;
  std::vector<std::uint32_t> new_number_;                     ///< by the number of a vertex before
  std::vector<std::pair<PlanarEdge, std::uint32_t>> pieces_;  ///< with the number of the edge before
};

}  // namespace

void lead_through_points(const SortedPoints& points, const std::vector<bool>& terrain,
                         std::vector<OwnedSegment>& segments, Progress& progress) {
  // Their ends are in order of x, then y, as the points on them are.
  for (OwnedSegment& s : segments)
    if (s.b < s.a) std::swap(s.a, s.b);
  const auto found = points_on(segments, terrain, points, progress, [](const OwnedSegment& s) {
    return LinePiece{s.a, s.b};
  });
  for (const auto& [number, point] : found) {
    OwnedSegment& rest = segments[number];
    OwnedSegment piece = rest;
    piece.b = rest.a = point;
    segments.push_back(piece);
  }
}

void lead_through_points(const SortedPoints& points, const std::vector<bool>& terrain, PlanarLines& lines,
                         Progress& progress) {
  const auto found = points_on(lines.edges, terrain, points, progress, [&](const PlanarEdge& e) {
    return LinePiece{lines.vertices[e.from], lines.vertices[e.to]};
  });
  if (!found.empty()) EdgeSplit(found, lines).run();
}

}  // namespace itin
