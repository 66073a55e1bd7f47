#include "modes/lines/surface_pieces.hpp"

#include <algorithm>
#include <utility>

#include <itin/grid_units.hpp>
#include <itin/topology.hpp>

#include "line/infinity.hpp"
#include "line/sight_line.hpp"

namespace itin::viewshed {

namespace {

/// Tells whether a place lies left of the line; a place on the line does.
bool lies_left(const SectionLine& line, const GridPoint& p) {
  return line.side(p) >= 0;
}

void add_piece(const SectionLine& line, const SectionCrossing& in, const SectionCrossing& out,
               std::vector<SurfacePieces::Piece>& pieces) {
  if (const auto piece = line.clip(in, out))
    pieces.push_back({{piece->from.distance, piece->from.position.z}, {piece->to.distance, piece->to.position.z}});
}

}  // namespace

SurfacePieces::SurfacePieces(std::shared_ptr<const HeightPyramid> surface)
    : surface_(std::move(surface)), neighbours_(adjacent_triangles(surface_->tin())) {}

void SurfacePieces::along(const SectionLine& line, std::vector<Piece>& pieces) const {
  if (!walk(line, pieces)) search(line, pieces);
}

bool SurfacePieces::walk(const SectionLine& line, std::vector<Piece>& pieces) const {
  pieces.clear();
  std::optional<Stop> at = first_stop(line);
  while (at) {
    const SectionCrossing out = line.crossing(corner(at->triangle, at->exit), corner(at->triangle, at->exit + 1));
    add_piece(line, at->in, out, pieces);
    if (out.place == SectionCrossing::Place::kBeyond || out.t >= 1) return true;
    const std::uint32_t next = neighbours_[at->triangle][at->exit];
    if (next == kNoNeighbour) return false;
    const auto& around = neighbours_[next];
    const auto entry =
        static_cast<std::uint32_t>(std::find(around.begin(), around.end(), at->triangle) - around.begin());
    // The corner before the entry's edge lies left of the line, the one behind it right: the third decides.
    const bool left = lies_left(line, corner(next, entry + 2));
    at = Stop{next, (entry + (left ? 1 : 2)) % 3, out};
  }
  return false;
}

/// A triangle that the line has entered at its start or before, and not left.
std::optional<SurfacePieces::Stop> SurfacePieces::first_stop(const SectionLine& line) const {
  using Place = SectionCrossing::Place;
  std::optional<Stop> first;
  surface_->for_each_triangle_near(place_in_units(grid(), line.start()), [&](std::uint32_t t) {
    const std::array<bool, 3> left{lies_left(line, corner(t, 0)), lies_left(line, corner(t, 1)),
                                   lies_left(line, corner(t, 2))};
    std::uint32_t entry = 3, exit = 3;
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (left[i] && !left[(i + 1) % 3]) entry = i;
      if (!left[i] && left[(i + 1) % 3]) exit = i;
    }
    if (exit == 3) return true;
    const SectionCrossing in = line.crossing(corner(t, entry), corner(t, entry + 1));
    const SectionCrossing out = line.crossing(corner(t, exit), corner(t, exit + 1));
    if ((in.place != Place::kBefore && in.t > 0) || out.place == Place::kBefore) return true;
    first = Stop{t, exit, in};
    return false;
  });
  return first;
}

void SurfacePieces::search(const SectionLine& line, std::vector<Piece>& pieces) const {
  pieces.clear();
  const Point2 from = place_in_units(grid(), line.start()), to = place_in_units(grid(), line.end());
  LineBundle bundle(SightLine({from.x, from.y, 0}, {to.x, to.y, 0}, 0, 0));
  bundle.margin = kInfinity;  // however far below
  RecentTriangles recent;
  surface_->search(bundle, [&](std::uint32_t t) {
    if (recent.seen(t)) return;
    if (const auto chord = line.chord(surface_->tin().corners(t))) add_piece(line, chord->from, chord->to, pieces);
  });
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return std::pair(a.from.distance_m, a.to.distance_m) < std::pair(b.from.distance_m, b.to.distance_m);
  });
}

}  // namespace itin::viewshed
