#include "triangulate/ground_beneath.hpp"

#include <cmath>
#include <cstdint>

#include <itin/error.hpp>
#include <itin/silent_progress.hpp>
#include <itin/sort_unique.hpp>
#include <itin/tin_heights.hpp>

#include "base/stoppable.hpp"
#include "geometry/window_over.hpp"
#include "triangulate/omitted_tops.hpp"
#include "triangulate/opened_region.hpp"
#include "triangulate/raised_index.hpp"
#include "triangulate/selected_tin.hpp"

namespace itin {

namespace {

/// How far, in grid units, a vertex on the border may lie from the edge that an import has put it on: rounding moves
/// the vertex by less than one step, and once more where lines were made planar.
constexpr double kBesideEdge = 1.5;
/// What holds that: whole steps.
constexpr int kStepsBesideEdge = 2;

Window window_over(const std::vector<GridBox>& boxes, const Grid& grid) {
  std::vector<Box> in_metres;
  for (const GridBox& box : boxes) in_metres.push_back(grid.box(box));
  return itin::window_over(in_metres);
}

std::vector<GridBox> boxes_of(const std::vector<TopsOfTheme>& tops, const Grid& grid) {
  std::vector<GridBox> boxes;
  for (const TopsOfTheme& theme : tops)
    for (const Box& box : theme.boxes) boxes.push_back(grid.enclosing(box));
  return boxes;
}

OpenedRegion region_of(const Store& store, const Selection& selection, const std::vector<TopsOfTheme>& tops,
                       const std::vector<GridBox>& boxes, Progress& progress) {
  using Vertex = OpenedRegion::Vertex;
  const Tin surface = triangulate_selected(store, window_over(boxes, store.metadata().grid), selection, progress);
  return {surface, [&](std::uint32_t v) {
            const std::uint16_t raised = surface.raised_theme.empty() ? std::uint16_t{0} : surface.raised_theme[v];
            if (raised == 0) return Vertex::ground;
            const auto theme =
                std::find_if(tops.begin(), tops.end(), [&](const TopsOfTheme& t) { return t.theme == raised; });
            return theme != tops.end() && has_code(theme->vertices, surface.id(v)) ? Vertex::top : Vertex::other;
          }};
}

/// Widens the boxes about tops to the triangles that have these for corners.
void enclose(const OpenedRegion& region, std::vector<GridBox>& boxes) {
  const BoxIndex near(boxes);
  for (const GridBox& triangle : region.boxes_of_triangles())
    near.for_each(triangle, [&](std::uint32_t i) { boxes[i].extend(triangle); });
}

/// The constraints that stay, as edges: what none of the new ones may cross.
std::vector<PlanEdge> kept_edges(const Store& store, const Selection& selection, const OpenedRegion& region,
                                 const std::vector<GridBox>& boxes) {
  const RaisedIndex index(store, selection);
  std::vector<PlanEdge> kept = region.borders();
  const auto is_top = [&](const Position& p) {
    return has_code(region.removed(), code_of(p)) || has_code(region.lowered(), code_of(p));
  };
  for (const GridBox& box : boxes) {
    std::vector<Segment> found;
    index.segments(box, found);
    for (const Segment& s : found)
      if (selection.selects(s) && !is_top(s.a()) && !is_top(s.b())) kept.push_back(plan_edge(s.a(), s.b()));
  }
  sort_unique(kept);
  return kept;
}

/// The edges of the terrain's triangles that reach the region's border, and its lines. A triangle reaches it also where
/// a vertex on the border belongs on one of its edges, and lies a step beyond.
std::vector<PlanEdge> edges_at_border(const Tin& bare, const OpenedRegion& region) {
  const auto position = [&](std::uint32_t v) { return Position{bare.vertices[v].x, bare.vertices[v].y}; };
  std::vector<PlanEdge> edges;
  for (const LineEdge& e : bare.lines) edges.push_back(plan_edge(position(e.from), position(e.to)));
  for (const auto& [a, b, c] : bare.triangles) {
    GridBox box;
    for (const std::uint32_t v : {a, b, c}) box.extend(bare.vertices[v].x, bare.vertices[v].y);
    bool near = false;
    region.for_each_border(expanded(box, kStepsBesideEdge), [&](const PlanEdge&) { near = true; });
    if (!near) continue;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      edges.push_back(plan_edge(position(from), position(to)));
  }
  sort_unique(edges);
  return edges;
}

/// The height of the ground at a position, in whole steps.
std::int32_t ground_at(const Tin& bare, const Position& at) {
  const auto metres = height_on(bare, bare.grid.position(at.x, at.y));
  if (!metres) throw Error("a feature that is left out stands on no ground; run itin check on the store");
  return static_cast<std::int32_t>(std::lround(*metres / bare.grid.resolution));
}

/// Cuts edges of the terrain at the region's border.
class EdgePieces {
 public:
  EdgePieces(const OpenedRegion& region, const std::vector<std::uint64_t>& restored, const std::vector<PlanEdge>& kept)
      : region_(region), restored_(restored), kept_(kept), kept_near_(boxes(kept)) {}

  /// Returns the pieces between vertices, within the region, that cross no constraint and none of each other.
  std::vector<PlanEdge> of(const std::vector<PlanEdge>& edges) const {
    std::vector<PlanEdge> pieces;
    for (const PlanEdge& e : edges) cut(e, pieces);
    sort_unique(pieces);
    const BoxIndex near(boxes(pieces));
    std::vector<bool> dropped(pieces.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
      near.for_each(extent_of(pieces[i]), [&](std::uint32_t j) {
        if (j < i && !dropped[j] && cross(pieces[i], pieces[j])) dropped[i] = true;
      });
    std::vector<PlanEdge> sound;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (!dropped[i]) sound.push_back(pieces[i]);
    return sound;
  }

 private:
  static std::vector<GridBox> boxes(const std::vector<PlanEdge>& edges) {
    std::vector<GridBox> all;
    for (const PlanEdge& e : edges) all.push_back(extent_of(e));
    return all;
  }

  bool is_vertex(const Position& p) const {
    const std::uint64_t code = code_of(p);
    return has_code(restored_, code) || has_code(region_.feet(), code);
  }

  /// The vertices along an edge, in order.
  std::vector<Position> stops(const PlanEdge& e) const {
    const double ex = double{1} * e.second.x - e.first.x, ey = double{1} * e.second.y - e.first.y;
    std::vector<std::pair<double, Position>> found;
    const auto add = [&](const Position& p) {
      const double px = double{1} * p.x - e.first.x, py = double{1} * p.y - e.first.y;
      const double along = px * ex + py * ey;
      if (along < 0 || along > ex * ex + ey * ey) return;
      if (std::abs(ex * py - ey * px) <= kBesideEdge * std::hypot(ex, ey)) found.emplace_back(along, p);
    };
    for (const Position& end : {e.first, e.second})
      if (is_vertex(end)) add(end);
    region_.for_each_border(expanded(extent_of(e), kStepsBesideEdge), [&](const PlanEdge& border) {
      for (const Position& end : {border.first, border.second})
        if (has_code(region_.feet(), code_of(end))) add(end);
    });
    sort_unique(found);
    std::vector<Position> positions;
    for (const auto& [along, p] : found) positions.push_back(p);
    return positions;
  }

  void cut(const PlanEdge& e, std::vector<PlanEdge>& pieces) const {
    const std::vector<Position> vertices = stops(e);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      const PlanEdge piece = plan_edge(vertices[i], vertices[i + 1]);
      if (region_.side_of_middle(piece.first, piece.second) == OpenedRegion::Side::inside && !crosses_kept(piece))
        pieces.push_back(piece);
    }
  }

  bool crosses_kept(const PlanEdge& piece) const {
    bool crosses = false;
    kept_near_.for_each(extent_of(piece), [&](std::uint32_t i) { crosses = crosses || cross(piece, kept_[i]); });
    return crosses;
  }

  const OpenedRegion& region_;
  const std::vector<std::uint64_t>& restored_;
  const std::vector<PlanEdge>& kept_;
  BoxIndex kept_near_;
};

}  // namespace

GroundBeneath::GroundBeneath(const Store& store, const Selection& selection, const std::vector<TopsOfTheme>& tops) {
  const StoreMetadata& metadata = store.metadata();
  std::vector<GridBox> boxes = boxes_of(tops, metadata.grid);
  if (boxes.empty()) return;
  NoProgress unstoppable;
  SilentProgress quiet(stopper() != nullptr ? *stopper() : unstoppable);
  const OpenedRegion region = region_of(store, selection, tops, boxes, quiet);
  removed_ = region.removed();
  if (removed_.empty() && region.lowered().empty()) return;
  enclose(region, boxes);
  const Tin bare =
      triangulate_selected(store, window_over(boxes, metadata.grid), selection.with_raised_alone(metadata, 0), quiet);
  for (const std::uint64_t code : region.lowered()) lowered_.emplace_back(code, ground_at(bare, position_of(code)));
  for (const GridPoint& p : bare.vertices)
    if (region.side_of({p.x, p.y}) == OpenedRegion::Side::inside) restored_.push_back(code_of(p));
  std::sort(restored_.begin(), restored_.end());
  const std::vector<PlanEdge> kept = kept_edges(store, selection, region, boxes);
  std::vector<PlanEdge> constraints = EdgePieces(region, restored_, kept).of(edges_at_border(bare, region));
  constraints.insert(constraints.end(), region.borders().begin(), region.borders().end());
  std::vector<GridBox> extents;
  for (const PlanEdge& e : constraints) {
    // The theme's number stands for ground that is kept about its features.
    segments_.push_back({e.first.x, e.first.y, e.second.x, e.second.y, tops.front().theme});
    extents.push_back(extent_of(e));
  }
  segments_near_ = BoxIndex(std::move(extents));
}

std::optional<std::int32_t> GroundBeneath::lowered(std::uint64_t code) const {
  const auto at = std::lower_bound(lowered_.begin(), lowered_.end(), std::pair(code, INT32_MIN));
  return at != lowered_.end() && at->first == code ? std::optional(at->second) : std::nullopt;
}

void GroundBeneath::segments(const GridBox& box, std::vector<Segment>& out) const {
  segments_near_.for_each(box, [&](std::uint32_t i) { out.push_back(segments_[i]); });
}

}  // namespace itin
