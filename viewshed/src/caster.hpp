// Casts sight lines from every eye to every cell of a grid, tile by tile.
#pragma once

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
  /// `targets` is what targets stand on, `bins` its triangles by the tiles of the result's grid. Everything must
  /// outlive the caster.
  Caster(const Tin& targets, const TriangleBins& bins, const Scene& scene, const std::vector<Eye>& eyes,
         const Observations& observations, Result& result);

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

  const Tin& targets_;
  const TriangleBins& bins_;
  const Scene& scene_;
  const std::vector<Eye>& eyes_;
  const Observations& observations_;
  Result& result_;
  RasterGrid tiles_;
  double grazing_;  ///< grid units
};

}  // namespace itin::viewshed
