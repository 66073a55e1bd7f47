// Two surfaces that hold the full surface, or a level's, between them, made of pieces of coarser levels and their
// certificates.
//
//   Envelope envelope = envelop(store, {.window = window, .level = 3}, progress);
//
// Every vertex of a level's triangulation is raised by the greatest upper bound, and lowered by the least lower bound,
// of all index cells that its triangles meet: between its vertices a bound then holds too (law 2). Pieces of finer
// levels lie about observers, where coarse ground would hide everything. Coarser triangles that lie wholly within these
// pieces are left out. Others overlap them, which is right as well, since every piece's bounds hold.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

#include "bounds/boundary.hpp"

namespace itin::viewshed {

/// Detail of at least this level within the circle.
struct FineDisc {
  Point2 centre;
  double radius = 0;  ///< metres
  int level = 0;
};

struct EnvelopeRequest {
  Window window = Window::all();
  int level = 0;
  int surface = 0;                             ///< the level whose surface lies between the two; no piece is finer
  std::vector<FineDisc> discs;                 ///< in any order
  ThemeChoice themes = ThemeChoice::none();    ///< what stands on the ground; at level 0 alone, without discs
  ThemeChoice cut_by = ThemeChoice::none();    ///< not read, but `lower` is as low as their foundations cut
  ThemeChoice enclosed = ThemeChoice::none();  ///< features that both surfaces hold between them, at any level
  std::optional<Window> bare_ground = std::nullopt;  ///< where the ground without features is wanted too
};

/// The two surfaces. Both have the same triangles, in the same order.
struct Envelope {
  Tin lower;
  Tin upper;
  std::vector<BoundaryEdge> outline;  ///< the edges of the coverage, of vertices and triangles of either
  bool exact = false;                 ///< one level throughout: `lower` is the surface
  std::optional<Tin> bare_ground;     ///< the full surface without what stands on it
};

/// Makes the two surfaces. Cost: that of triangulate(), and about a microsecond per triangle. Throws what triangulate()
/// throws.
Envelope envelop(const Store& store, const EnvelopeRequest& request, Progress& progress);

}  // namespace itin::viewshed
