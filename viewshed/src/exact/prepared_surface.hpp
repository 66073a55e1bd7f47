// The surface that a viewshed is computed over, once it has been read: triangles, or the posts of a lattice.
#pragma once

#include <memory>

#include <itin/lattice_reader.hpp>
#include <itin/tin.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/binned_heights.hpp"
#include "modes/lines/triangle_finders.hpp"
#include "scene/kept_ground.hpp"

namespace itin::viewshed {

struct PreparedSurface {
  // One of these two is given.
  const Tin* tin = nullptr;
  const LatticeTin* lattice = nullptr;
  LatticeReader* reader = nullptr;                   ///< reads the lattice, where heights may have to be read
  const Tin* bare = nullptr;                         ///< what ends stand on, where that is not the surface
  Box extent;                                        ///< the box that cells are laid over
  std::shared_ptr<BinnedHeights> heights = nullptr;  ///< the surface's, where they have been binned
  const KeptGround* ground = nullptr;                ///< what targets stand on, where it is kept
  // What finds triangles along lines, where it is kept:
  const TriangleFinders* finders = nullptr;       ///< those of `tin`
  const TriangleFinders* bare_finders = nullptr;  ///< those of `bare`

  const Grid& units() const { return lattice != nullptr ? lattice->grid : tin->grid; }
};

/// Computes a viewshed over the surface. Safe for concurrent use where there is no reader.
Result compute(const PreparedSurface& over, const Request& request, Progress& progress, const CellSink& sink = {});

}  // namespace itin::viewshed
