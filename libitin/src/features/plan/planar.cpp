#include "features/plan/planar.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include <itin/box_of.hpp>
#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "features/plan/hot_pixel.hpp"
#include "geometry/cell_about.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

Position position(const GridPoint& p) {
  return {p.x, p.y};
}

/// A source of a vertex's height; the least one counts.
struct Height {
  std::uint64_t code;
  std::uint32_t owner;
  bool interpolated;
  std::int64_t depth;  ///< the height's negative
  friend auto operator<=>(const Height&, const Height&) = default;
};

/// Positions sorted along the Morton curve, to be found along a segment.
class SortedPositions {
 public:
  explicit SortedPositions(std::vector<std::uint64_t> codes) : codes_(std::move(codes)) { sort_unique(codes_); }

  /// Calls visit(position) for every position whose pixel the segment may meet.
  template <class Visit>
  void along(Position a, Position b, const Visit& visit) const {
    // Enter the tree at the smallest cell around what is near.
    const Cell cell = cell_about(expanded(box_of(std::array{a, b}), 1));
    const At first = std::lower_bound(codes_.begin(), codes_.end(), cell.code);
    descend({a.x, a.y, b.x, b.y}, cell, first, std::lower_bound(first, codes_.end(), cell.end()), visit);
  }

 private:
  using At = std::vector<std::uint64_t>::const_iterator;
  static constexpr std::ptrdiff_t kFew = 4;

  template <class Visit>
  void descend(const Segment& s, Cell cell, At first, At last, const Visit& visit) const {
    if (first == last) return;
    if (last - first <= kFew || cell.log2_side == 0) {
      for (; first != last; ++first) visit(Position{morton_x(*first), morton_y(*first)});
      return;
    }
    for (int i = 0; i < 4; ++i) {
      const Cell child = cell.child(i);
      const At end = i == 3 ? last : std::lower_bound(first, last, child.end());
      if (first != end && near(s, child)) descend(s, child, first, end, visit);
      first = end;
    }
  }

  /// Whether the segment comes within a step of the cell: the cell's pixels reach half a step beyond its positions.
  static bool near(const Segment& s, const Cell& cell) {
    const GridBox box = cell.box();
    if (std::max(s.ax, s.bx) < box.xmin - 1 || std::min(s.ax, s.bx) > box.xmax + 1) return false;
    if (std::max(s.ay, s.by) < box.ymin - 1 || std::min(s.ay, s.by) > box.ymax + 1) return false;
    bool left = false, right = false;
    for (const Position c : {Position{box.xmin - 1, box.ymin - 1}, Position{box.xmax + 1, box.ymin - 1},
                             Position{box.xmin - 1, box.ymax + 1}, Position{box.xmax + 1, box.ymax + 1}}) {
      const int side = orientation(s.a(), s.b(), c);
      left |= side >= 0;
      right |= side <= 0;
    }
    return left && right;
  }

  std::vector<std::uint64_t> codes_;
};

class SnapRounding {
 public:
  SnapRounding(std::vector<OwnedSegment> segments, const Progress* progress)
      : segments_(std::move(segments)), progress_(progress) {
    for (OwnedSegment& s : segments_) {
      if (s.b < s.a) std::swap(s.a, s.b);
    }
    sort_unique(segments_);
  }

  PlanarLines run() && {
    find_hot_pixels();
    stop_if_asked();
    const SortedPositions hot(std::move(hot_));
    for (const OwnedSegment& s : segments_) {
      check_cancelled();
      round(s, hot);
    }
    stop_if_asked();
    choose_heights();
    stop_if_asked();
    split_at_vertices();
    stop_if_asked();
    return number();
  }

 private:
  /// Looks for cancellation now and then only, so that it costs next to nothing.
  void check_cancelled() {
    if (progress_ != nullptr && ++steps_ % 1024 == 0) progress_->throw_if_cancelled();
  }

  struct Piece {
    Position from, to;
    std::uint32_t owner, feature;
    friend auto operator<=>(const Piece&, const Piece&) = default;
  };

  void find_hot_pixels() {
    std::vector<Segment> plain;
    for (const OwnedSegment& s : segments_) {
      hot_.push_back(code_of(position(s.a)));
      hot_.push_back(code_of(position(s.b)));
      if (position(s.a) != position(s.b)) plain.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
    }
    std::set<std::pair<Segment, Segment>> crossing;
    for_each_edge_leaf(std::move(plain), [&](const Cell&, const std::vector<Segment>& near) {
      check_cancelled();
      // The segments ascend by ax, and ax <= bx: one that begins right of s's end does not meet s.
      for (std::size_t i = 0; i < near.size(); ++i) {
        for (std::size_t j = i + 1; j < near.size() && near[j].ax <= near[i].bx; ++j) {
          const Segment &s = near[i], &t = near[j];
          if (std::min(t.ay, t.by) > std::max(s.ay, s.by) || std::max(t.ay, t.by) < std::min(s.ay, s.by)) continue;
          if (crosses(s, t.a(), t.b())) crossing.insert({s, t});
        }
      }
    });
    crossings_ = crossing.size();
    for (const auto& [s, t] : crossing) hot_.push_back(code_of(crossing_pixel(s.a(), s.b(), t.a(), t.b())));
  }

  /// Leads a segment through the centres of the hot pixels it meets. It visits pixels in steps that never turn back in
  /// x or y, so the sum of the ways made in x and y gives their order.
  void round(const OwnedSegment& s, const SortedPositions& hot) {
    const Position a = position(s.a), b = position(s.b);
    std::vector<std::pair<std::int64_t, Position>> way;
    const std::int64_t x_sign = (b.x > a.x) - (b.x < a.x), y_sign = (b.y > a.y) - (b.y < a.y);
    hot.along(a, b, [&](Position p) {
      if (meets_pixel(a, b, p)) way.emplace_back(x_sign * p.x + y_sign * p.y, p);
    });
    std::sort(way.begin(), way.end());
    for (const auto& [order, p] : way) heights_.push_back(height_at(s, p));
    for (std::size_t i = 1; i < way.size(); ++i) add_piece(way[i - 1].second, way[i].second, s);
  }

  static Height height_at(const OwnedSegment& s, Position p) {
    if (p == position(s.a) || p == position(s.b)) {
      const std::int64_t z = p != position(s.b) ? s.a.z : p != position(s.a) ? s.b.z : std::max(s.a.z, s.b.z);
      return {code_of(p), s.owner, false, -z};
    }
    const std::int64_t dx = std::int64_t{s.b.x} - s.a.x, dy = std::int64_t{s.b.y} - s.a.y;
    const std::int64_t along = dx * (std::int64_t{p.x} - s.a.x) + dy * (std::int64_t{p.y} - s.a.y);
    const std::int64_t rise = rounded_quotient(Int128{along} * (std::int64_t{s.b.z} - s.a.z), dx * dx + dy * dy);
    // A hot pixel's centre may lie a little beyond the segment's end.
    const auto [low, high] = std::minmax(s.a.z, s.b.z);
    return {code_of(p), s.owner, true, -std::clamp<std::int64_t>(s.a.z + rise, low, high)};
  }

  /// Adds the piece pq; `of` is the segment that it is part of, or a longer piece.
  template <class Whole>
  void add_piece(Position p, Position q, const Whole& of) {
    if (q < p) std::swap(p, q);
    pieces_.push_back({p, q, of.owner, of.feature});
  }

  /// The heights that count, one per position.
  void choose_heights() {
    std::sort(heights_.begin(), heights_.end());
    heights_.erase(std::unique(heights_.begin(), heights_.end(),
                               [](const Height& a, const Height& b) { return a.code == b.code; }),
                   heights_.end());
    sort_pieces();
  }

  void sort_pieces() { sort_unique(pieces_); }

  /// Rounding may lay a piece exactly through a vertex that its segment missed.
  void split_at_vertices() {
    std::vector<std::uint64_t> ends;
    for (const Piece& piece : pieces_) {
      ends.push_back(code_of(piece.from));
      ends.push_back(code_of(piece.to));
    }
    const SortedPositions vertices(std::move(ends));
    const std::vector<Piece> whole = std::exchange(pieces_, {});
    for (const Piece& piece : whole) {
      check_cancelled();
      std::vector<Position> way{piece.from, piece.to};
      vertices.along(piece.from, piece.to, [&](Position p) {
        if (p != piece.from && p != piece.to && on_segment(piece.from, piece.to, p)) way.push_back(p);
      });
      std::sort(way.begin(), way.end());  // by x, then y: in order along a straight line
      for (std::size_t i = 1; i < way.size(); ++i) add_piece(way[i - 1], way[i], piece);
    }
    sort_pieces();
  }

  PlanarLines number() const {
    PlanarLines lines;
    lines.crossings = crossings_;
    std::vector<std::uint64_t> codes;
    for (const Piece& piece : pieces_) {
      codes.push_back(code_of(piece.from));
      codes.push_back(code_of(piece.to));
    }
    sort_unique(codes);
    for (const std::uint64_t code : codes) {
      stop_if_asked();
      const auto height = std::lower_bound(heights_.begin(), heights_.end(), code,
                                           [](const Height& h, std::uint64_t c) { return h.code < c; });
      lines.vertices.push_back({morton_x(code), morton_y(code), static_cast<std::int32_t>(-height->depth)});
    }
    const auto number_of = [&](Position p) {
      return static_cast<std::uint32_t>(std::lower_bound(codes.begin(), codes.end(), code_of(p)) - codes.begin());
    };
    std::vector<std::pair<PlanarEdge, std::uint32_t>> of_features;
    for (const Piece& piece : pieces_) {
      stop_if_asked();
      const auto [from, to] = std::minmax({number_of(piece.from), number_of(piece.to)});
      of_features.push_back({{from, to, piece.owner}, piece.feature});
    }
    std::sort(of_features.begin(), of_features.end());
    for (const auto& [edge, feature] : of_features) {
      if (lines.edges.empty() || lines.edges.back() != edge) lines.edges.push_back(edge);
      if (feature != kNoFeature)
        lines.features.push_back({static_cast<std::uint32_t>(lines.edges.size() - 1), feature});
    }
    return lines;
  }

  std::vector<OwnedSegment> segments_;
  std::vector<std::uint64_t> hot_;
  std::vector<Height> heights_;
  std::vector<Piece> pieces_;
  std::uint64_t crossings_ = 0;
  const Progress* progress_;
  std::uint64_t steps_ = 0;
};

}  // namespace

PlanarLines make_planar(std::vector<OwnedSegment> segments, const Progress* progress) {
  return SnapRounding(std::move(segments), progress).run();
}

}  // namespace itin
