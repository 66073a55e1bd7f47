// Casts sight lines from every eye to every cell of a grid, tile by tile.
#pragma once

#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/viewshed.hpp>

#include "eye.hpp"
#include "observation.hpp"
#include "scene.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

class Caster {
 public:
  /// `targets` is what targets stand on, `bins` its triangles by the tiles of the result's grid; `cover` is the surface
  /// that may lie over them, null where it is the same. Everything must outlive the caster.
  Caster(const Tin& targets, const TriangleBins& bins, const Tin* cover, const Scene& scene,
         const std::vector<Eye>& eyes, const Observations& observations, Result& result);

  /// Fills the result's rasters, cells, rays and error bound. Throws Cancelled.
  void run(Progress& progress);

 private:
  struct Tally {
    CellCounts cells;
    std::uint64_t rays = 0;
    double longest = 0;  ///< metres
  };
  struct TileWork;

  Tally decide(std::size_t tile) const;
  std::vector<std::uint32_t> eyes_near(const Tile& tile) const;
  void look(std::uint32_t observer, std::int64_t row, std::int64_t column, TileWork& work) const;
  void find_covered_eyes(const Tin& cover);

  const Tin& targets_;
  const TriangleBins& bins_;
  const Scene& scene_;
  const std::vector<Eye>& eyes_;
  const Observations& observations_;
  Result& result_;
  RasterGrid tiles_;
  double grazing_;  ///< grid units
  /// A line whose ends both lie under the surface need not cross it, and is hidden all the same.
  const Tin* cover_;                   ///< null where no eye lies under it
  std::vector<std::uint8_t> covered_;  ///< an eye
  std::optional<TriangleBins> cover_bins_;
};

}  // namespace itin::viewshed
