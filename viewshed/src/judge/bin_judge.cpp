#include "judge/bin_judge.hpp"

#include <utility>

#include "judge/bounded_target.hpp"

namespace itin::viewshed {

class BinJudge::BinWork final : public TileJudge::Work {
 public:
  BinWork(const BinJudge& judge, std::size_t tile)
      : judge_(judge), tile_(tile_at(judge.grid_, judge.tiles_, tile)), centres_(judge.units_, judge.grid_, tile_) {}

  std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) override {
    const RasterGrid& grid = judge_.grid_;
    eye_ = &judge_.eyes_[eye];
    std::uint64_t lines = 0;
    for_each_cell(tile_, [&](std::size_t cell, RasterGrid::Cell place) {
      if (values[cell] != Verdict::kUndecided) return;
      ++lines;
      values[cell] =
          verdict_by_bins(judge_.walk_, *eye_, judge_.units_.resolution, grid.centre(place.column, place.row),
                          centres_.at(cell), judge_.ground_[grid.index(place)]);
    });
    return lines;
  }

  TileTargets targets() override {
    const double resolution = judge_.units_.resolution;
    for_each_cell(tile_, [&](std::size_t cell, RasterGrid::Cell place) {
      targets_[cell] = eye_->target(judge_.ground_[judge_.grid_.index(place)] * resolution) / resolution;
    });
    return {centres_, targets_, targets_};
  }

 private:
  const BinJudge& judge_;
  Tile tile_;
  TileCentres centres_;
  const Eye* eye_ = nullptr;  ///< the eye that was judged last
  TileValues<double> targets_;
};

BinJudge::BinJudge(const BinWalk& walk, const Grid& units, const RasterGrid& grid, const RasterGrid& tiles,
                   const std::vector<double>& ground, std::vector<Eye> eyes)
    : walk_(walk), units_(units), grid_(grid), tiles_(tiles), ground_(ground), eyes_(std::move(eyes)) {}

std::unique_ptr<TileJudge::Work> BinJudge::begin(std::size_t tile) const {
  return std::make_unique<BinWork>(*this, tile);
}

Verdict verdict_by_bins(const BinWalk& walk, const Eye& eye, double resolution, Point2 centre, Point2 place,
                        double ground) {
  const double metres = ground * resolution;
  const BoundedTarget target = bounded_target(eye, centre, place, metres, metres);
  if (target.verdict != Verdict::kUndecided) return target.verdict;
  return walk.along(eye.units, {place.x, place.y, target.low / resolution});
}

}  // namespace itin::viewshed
