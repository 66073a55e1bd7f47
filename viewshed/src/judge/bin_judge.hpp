// Cells judged line by line, by how low and how high the surface is within bins (bin_walk.hpp). It takes a fraction of
// a microsecond per line, whatever stands on the surface.
//
//   const BinJudge judge(walk, grid, tiles, ground, eyes);
#pragma once

#include <memory>
#include <vector>

#include "judge/bin_walk.hpp"
#include "judge/tile_judge.hpp"

namespace itin::viewshed {

class BinJudge final : public TileJudge {
 public:
  /// `tiles` are the tiles of `grid`. `ground` is the height of what targets stand on at each of the grid's cells, grid
  /// units; kNoSurface where there is none. Ground without data hides nothing. All but the eyes must outlive this
  /// object.
  BinJudge(const BinWalk& walk, const Grid& units, const RasterGrid& grid, const RasterGrid& tiles,
           const std::vector<double>& ground, std::vector<Eye> eyes);

  std::unique_ptr<Work> begin(std::size_t tile) const override;
  const Eye& eye(std::size_t number) const override { return eyes_[number]; }

 private:
  class BinWork;

  const BinWalk& walk_;
  const Grid& units_;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  const std::vector<double>& ground_;
  std::vector<Eye> eyes_;
};

/// The verdict on a target at `place`, grid units, on ground of this height, grid units; `centre` is the same place in
/// metres.
Verdict verdict_by_bins(const BinWalk& walk, const Eye& eye, double resolution, Point2 centre, Point2 place,
                        double ground);

}  // namespace itin::viewshed
