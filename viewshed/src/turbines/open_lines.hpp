// The sight lines of a zone that a surface with features leaves open, and the ground where it may rise into them: no
// other ground with its features has to be read.
//
//   OpenLines open(store, zone, part.window, progress);
//   const std::optional<Window> window = open.mark(ground, part.tiles, *zone.screened, progress);
//
// Two coarse surfaces enclose the one with features (window/envelope.hpp). Cells from which the lower one hides a
// turbine's tip, block by block, do not see it whatever stands there; over ground where the upper one lies below all
// lines that are left, down to the turbine's base, nothing hides.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>
#include <viewshed/turbines.hpp>

#include "bounds/envelope_bounds.hpp"
#include "bounds/height_pyramid.hpp"
#include "plan/ground_tiles.hpp"
#include "scene/exact_scene.hpp"
#include "scene/sweep/horizon_view.hpp"

namespace itin::viewshed {

/// Tells whether the open lines over the zone's surface with features can be found: at full detail, in a store of
/// several levels.
bool may_tell_open_lines(const Store& store, const ZoneRequest& request);

class OpenLines {
 public:
  /// Retrieves the coarse surfaces within the window, which holds all lines. Store and zone must outlive this object.
  /// Precondition: may_tell_open_lines().
  OpenLines(const Store& store, const Zone& zone, const Window& window, Progress& progress);

  /// Sets the bits in `open.turbines` of all lines from the cells of these tiles that are left open. Returns the ground
  /// where features may hide them; nothing where no line is left open. Eyes stand on `ground`, whose grid is the
  /// zone's. Throws Cancelled.
  std::optional<Window> mark(const ExactScene& ground, std::span<const std::size_t> tiles, Visibility& open,
                             Progress& progress) const;

  const RetrievalStatistics& retrieval() const { return retrieval_; }

 private:
  class TileMarker;

  void bound(const Store& store, const Window& window, Progress& progress);
  void view_turbines();
  void roof_tiles();

  const Zone& zone_;
  const Grid units_;
  RetrievalStatistics retrieval_;
  std::optional<EnvelopeBounds> bounds_;
  std::vector<HorizonView> views_;  ///< one for each turbine
  std::optional<GroundTiles> tiles_;
  Tin roofs_;  ///< above each tile, two level triangles as high as anything on the tile
  std::optional<HeightPyramid> pyramid_;
};

}  // namespace itin::viewshed
