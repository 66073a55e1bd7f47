#include "cross_section/section_walk.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <itin/error.hpp>
#include <itin/section_themes.hpp>

namespace itin {

namespace {

using Place = SectionCrossing::Place;

/// A crossing, and the theme of the feature that it lies within. The theme follows from the vertex or the edge that is
/// crossed, and not from the triangles beside it: where the line runs along an edge, the walk knows only one of them.
struct Met : SectionCrossing {
  std::uint16_t theme = 0;
  bool at_vertex = false;
};

/// Consecutive breakpoints over ground without a gap.
struct Stretch {
  std::vector<Met> crossings;
  std::uint64_t triangles = 0;

  double from() const { return crossings.front().distance; }
  double to() const { return crossings.back().distance; }

  /// Adds a crossing. A vertex on the line is crossed with several edges at once; where a crossing comes twice, the
  /// second theme is the better one.
  void add(const Met& c) {
    if (!crossings.empty()) {
      Met& last = crossings.back();
      if (c.t <= last.t && c.position == last.position) {
        last.theme = c.theme;
        return;
      }
    }
    crossings.push_back(c);
  }
};

/// An edge that the line crosses, and the sides of the line that its ends are on.
struct SidedEdge : CrossedEdge {
  SidedEdge(const CrossedEdge& edge, const SectionLine& line)
      : CrossedEdge(edge), left_side(line.side(edge.left)), right_side(line.side(edge.right)) {}

  Int128 left_side, right_side;
};

class SectionWalk {
 public:
  SectionWalk(const PointIndex& index, const SectionLine& line, TriangleFinder& triangles, OnLine on_line)
      : line_(line), triangles_(triangles), on_line_(on_line), ground_(ground_runs(index, line, on_line)) {}

  bool touches_outline() const { return ground_.touches; }

  std::vector<Stretch> run() {
    std::vector<Stretch> stretches;
    for (const GroundRun& run : ground_.runs) {
      const std::optional<CrossedEdge> entry =
          run.entry ? triangles_.edge_on(*run.entry, line_, on_line_) : edge_before_start();
      if (entry) stretches.push_back(walk(*entry, run.exit));
      if (!entry && run.exit) throw Error("there is no ground before the outline; run itin check on the store");
    }
    return stretches;
  }

 private:
  bool left(const GridPoint& p) const { return counts_as_left(line_.side(p), on_line_); }

  /// Returns the edge by which the line, prolonged backwards, enters the triangle about its start: the first such edge,
  /// where several triangles share the start. Nothing where there is no ground.
  std::optional<CrossedEdge> edge_before_start() {
    const GridBox box = line_.start_box();
    std::optional<CrossedEdge> first;
    for (const std::array<SectionVertex, 3>& triangle : triangles_.around(box)) {
      const std::optional<CrossedEdge> entry = entry_into(triangle);
      if (!entry || (first && !SectionLine::crossed_before(entry->left, entry->right, first->left, first->right))) {
        continue;
      }
      first = entry;
    }
    return first;
  }

  /// Returns the edge by which the line enters a triangle that contains its start.
  std::optional<CrossedEdge> entry_into(const std::array<SectionVertex, 3>& triangle) const {
    std::optional<CrossedEdge> entry, exit;
    for (std::size_t i = 0; i < 3; ++i) {
      const SectionVertex &p = triangle[i], &q = triangle[(i + 1) % 3];
      if (left(p) && !left(q)) entry = CrossedEdge{p, q};
      if (!left(p) && left(q)) exit = CrossedEdge{q, p};
    }
    if (!entry || !exit) return std::nullopt;
    const SectionCrossing in = line_.crossing(entry->left, entry->right);
    const SectionCrossing out = line_.crossing(exit->left, exit->right);
    if (in.place != Place::kBefore && in.t != 0) return std::nullopt;
    if (out.place == Place::kBefore) return std::nullopt;
    return entry;
  }

  Stretch walk(const CrossedEdge& entry, const std::optional<OutlineCrossing>& exit) {
    Stretch stretch;
    SidedEdge edge(entry, line_);
    Met in = met(edge);
    if (in.place == Place::kWithin) stretch.add(in);
    while (!at_end(in) && !(exit && lies_on(edge, *exit))) {
      const SectionVertex c = triangles_.beyond(edge);
      const std::uint16_t theme = theme_of_edge(theme_of_edge(edge.left.theme, edge.right.theme), c.theme);
      const Int128 side = line_.side(c);
      if (counts_as_left(side, on_line_)) {
        edge.left = c, edge.left_side = side;
      } else {
        edge.right = c, edge.right_side = side;
      }
      const Met out = met(edge);
      add_piece(in, out, theme, stretch);
      in = out;
    }
    if (stretch.crossings.empty()) throw Error("a cross-section lost its way; run itin check on the store");
    return stretch;
  }

  bool at_end(const SectionCrossing& c) const {
    return c.place == Place::kBeyond || (c.place == Place::kWithin && c.t == (line_.is_point() ? 0 : 1));
  }

  Met met(const SidedEdge& edge) const {
    Met result{line_.crossing(edge.left, edge.left_side, edge.right, edge.right_side)};
    result.theme = theme_of_edge(edge.left.theme, edge.right.theme);
    if (edge.left_side == 0) result.theme = edge.left.theme, result.at_vertex = true;
    if (edge.right_side == 0) result.theme = edge.right.theme, result.at_vertex = true;
    return result;
  }

  /// Adds a piece of the line between two crossings; `theme` is the triangle's.
  void add_piece(const Met& in, const Met& out, std::uint16_t theme, Stretch& stretch) const {
    const std::optional<SectionPiece> piece = line_.clip(in, out);
    if (!piece) return;
    ++stretch.triangles;
    if (in.at_vertex && out.at_vertex) theme = theme_of_edge(in.theme, out.theme);  // along an edge, or without length
    stretch.add({piece->from, in.place == Place::kWithin ? in.theme : piece->from.t == out.t ? out.theme : theme});
    stretch.add({piece->to, out.place == Place::kWithin ? out.theme : piece->to.t == in.t ? in.theme : theme});
  }

  static bool lies_on(const CrossedEdge& edge, const OutlineCrossing& segment) {
    return orientation(segment.left, segment.right, edge.left) == 0 &&
           orientation(segment.left, segment.right, edge.right) == 0;
  }

  const SectionLine& line_;
  TriangleFinder& triangles_;
  OnLine on_line_;
  GroundRuns ground_;
};

/// Joins stretches that overlap or touch: beside the outline one side of the line has ground where the other has none.
std::vector<Stretch> united(std::vector<Stretch> stretches) {
  const auto by_place = [](const Stretch& a, const Stretch& b) { return a.from() < b.from(); };
  std::stable_sort(stretches.begin(), stretches.end(), by_place);
  std::vector<Stretch> result;
  for (Stretch& s : stretches) {
    if (result.empty() || s.from() > result.back().to()) {
      result.push_back(std::move(s));
      continue;
    }
    Stretch& last = result.back();
    if (s.to() > last.to()) last.triangles += s.triangles;
    std::vector<Met> all = std::move(last.crossings);
    all.insert(all.end(), s.crossings.begin(), s.crossings.end());
    std::stable_sort(all.begin(), all.end(), [](const Met& a, const Met& b) { return a.t < b.t; });
    last.crossings.clear();
    for (const Met& c : all) last.add(c);
  }
  return result;
}

CrossSection section_of(const SectionLine& line, const std::vector<Stretch>& stretches) {
  CrossSection section;
  section.length = line.length();
  section.one_place = line.is_one_place();
  double covered = 0;
  bool started = false;
  for (const Stretch& s : stretches) {
    if (s.from() > covered) section.gaps.push_back({covered, s.from()});
    double distance = s.from();
    for (const Met& c : s.crossings) {
      // Crossings that differ by a rounding error may come in the wrong order.
      distance = std::max(distance, c.distance);
      section.breakpoints.push_back({distance, c.position, c.theme});
    }
    covered = distance, started = true;
    section.triangles += s.triangles;
  }
  if (!started || covered < line.length()) section.gaps.push_back({covered, line.length()});
  return section;
}

void mirror(CrossSection& section) {
  std::reverse(section.breakpoints.begin(), section.breakpoints.end());
  for (Breakpoint& b : section.breakpoints) b.distance = section.length - b.distance;
  std::reverse(section.gaps.begin(), section.gaps.end());
  for (SectionGap& g : section.gaps) g = {section.length - g.to, section.length - g.from};
}

}  // namespace

CrossSection walk_section(const PointIndex& index, const SectionLine& line, TriangleFinder& triangles) {
  SectionWalk walk(index, line, triangles, OnLine::kLeft);
  std::vector<Stretch> stretches = walk.run();
  if (walk.touches_outline()) {
    const std::vector<Stretch> others = SectionWalk(index, line, triangles, OnLine::kRight).run();
    stretches.insert(stretches.end(), others.begin(), others.end());
  }
  CrossSection section = section_of(line, united(std::move(stretches)));
  if (line.is_mirrored()) mirror(section);
  return section;
}

namespace {

/// The selected vertices of a segment next to its crossing, among those in a box about it.
class NeighboursOnSegment {
 public:
  NeighboursOnSegment(const OutlineCrossing& segment, const SectionLine& line, OnLine on_line)
      : segment_(segment), line_(line), on_line_(on_line) {}

  void consider(const SectionVertex& p) {
    const GridBox box{std::min(segment_.left.x, segment_.right.x), std::min(segment_.left.y, segment_.right.y),
                      std::max(segment_.left.x, segment_.right.x), std::max(segment_.left.y, segment_.right.y)};
    if (!box.contains(p.x, p.y) || orientation(segment_.left, segment_.right, p) != 0) return;
    const bool on_left = counts_as_left(line_.side(p), on_line_);
    std::optional<SectionVertex>& nearest = on_left ? left_ : right_;
    const auto distance = [this](const SectionVertex& q) {
      const Int128 side = line_.side(q);
      return side < 0 ? -side : side;
    };
    if (!nearest || distance(p) < distance(*nearest)) nearest = p;
  }

  std::optional<CrossedEdge> edge() const {
    if (!left_ || !right_) return std::nullopt;
    return CrossedEdge{*left_, *right_};
  }

 private:
  OutlineCrossing segment_;
  const SectionLine& line_;
  OnLine on_line_;
  std::optional<SectionVertex> left_, right_;
};

/// Estimates the distance between neighbouring vertices, metres.
double spacing_at(const PointIndex& index, const Selection& selection, const Grid& grid, const Point3& place) {
  const GridBox box = grid.enclosing({place.x, place.y, place.x, place.y});
  std::vector<Leaf> leaves;
  selected_leaves(index, selection, box, leaves);
  double density = 0;
  for (const Leaf& leaf : leaves) density += leaf.asked * std::ldexp(1.0, -2 * leaf.cell.log2_side);
  return grid.resolution * (density > 0 ? std::max(1 / std::sqrt(density), 1.0) : 64);
}

}  // namespace

Point2 heading_of(const SectionLine& line) {
  const double dx = line.end().x - line.start().x, dy = line.end().y - line.start().y, length = std::hypot(dx, dy);
  return length > 0 ? Point2{dx / length, dy / length} : Point2{1, 0};
}

CrossedEdge find_edge_on(const PointIndex& index, const Selection& selection, const OutlineCrossing& segment,
                         const SectionLine& line, OnLine on_line, RetrievalStatistics& statistics) {
  const auto point = [](Position p) { return GridPoint{p.x, p.y, 0}; };
  const Point3 place = line.crossing(point(segment.left), point(segment.right)).position;
  const GridBox all = index.bounds();
  std::vector<Leaf> leaves;
  for (double reach = spacing_at(index, selection, line.grid(), place);; reach *= 4) {
    const GridBox box = line.grid().enclosing({place.x - reach, place.y - reach, place.x + reach, place.y + reach});
    leaves.clear();
    selected_leaves(index, selection, box, leaves);
    NeighboursOnSegment neighbours(segment, line, on_line);
    for (const Leaf& leaf : leaves) {
      const auto block = index.unordered_block(leaf);
      statistics.points_read += block->points.size();
      statistics.blocks_read += 1;
      for (std::size_t k = 0; k < block->points.size(); ++k) {
        const GridPoint& p = block->points[k];
        if (box.contains(p.x, p.y) && selection.selects(leaf, level_of(leaf, *block, k), p.x, p.y))
          neighbours.consider({p, block->theme(k)});
      }
    }
    // The box is centred on the crossing, so that vertices outside it are farther away along the segment.
    if (const auto edge = neighbours.edge()) return *edge;
    if (box.contains(all)) throw Error("an end of a constraint line is not among the vertices; run itin check");
  }
}

}  // namespace itin
