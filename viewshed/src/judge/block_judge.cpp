#include "judge/block_judge.hpp"

#include <algorithm>
#include <utility>

#include <itin/grazing.hpp>

#include "bounds/surface_heights.hpp"
#include "judge/bounded_target.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

class BlockJudge::BlockWork final : public TileJudge::Work {
 public:
  BlockWork(const BlockJudge& judge, std::size_t tile)
      : judge_(judge),
        number_(tile),
        tile_(tile_at(judge.grid_, judge.tiles_, tile)),
        resolution_(judge.surface_.bounds().units().resolution),
        centres_(judge.surface_.bounds().units(), judge.grid_, tile_),
        all_(all_of(tile_)) {}

  std::uint64_t judge(std::size_t, TileValues<Verdict>& values) override {
    const TileValues<Verdict> asked = values;
    hide(all_, asked, values);
    judge_cells(all_, asked, values);
    if (judge_.nearby_ != nullptr) take_nearby(asked, values);
    return 0;
  }

  TileTargets targets() override {
    const Heights& heights = this->heights();
    for (std::size_t cell = 0; cell < low_.size(); ++cell) {
      low_[cell] = judge_.eye_.target(heights.low[cell] * resolution_) / resolution_;
      high_[cell] = judge_.eye_.target(heights.high[cell] * resolution_) / resolution_;
    }
    return {centres_, low_, high_};
  }

 private:
  /// The least and the greatest height of the surface at cell centres, grid units; kNoSurface where none is.
  struct Heights {
    TileValues<double> low, high;
  };

  BinBox box_of(const CellBlock& block) const { return box_about(block, centres_, judge_.surface_.bounds()); }

  static void decide(const CellBlock& block, Verdict verdict, const TileValues<Verdict>& asked,
                     TileValues<Verdict>& values) {
    for_each_cell(block, [&](std::size_t cell) {
      if (asked[cell] == Verdict::kUndecided) values[cell] = verdict;
    });
  }

  /// Hides the block where that is certain, and otherwise what it can of its quarters, down to about a bin.
  void hide(const CellBlock& block, const TileValues<Verdict>& asked, TileValues<Verdict>& values) const {
    const BinBox box = box_of(block);
    const double highest = judge_.surface_.bounds().highest(box) + judge_.surface_.rises().over(tile_, block);
    if (highest == -kInfinity) return;
    if (judge_.horizon_.hides(box, judge_.eye_.target(highest * resolution_) / resolution_))
      return decide(block, Verdict::kHidden, asked, values);
    if (std::max(box.east - box.west, box.south - box.north) <= kSmallest) return;
    for_each_quarter(block, [&](const CellBlock& quarter) { hide(quarter, asked, values); });
  }

  /// Tells whether every cell has ground and is in view, and none has a rule of its own.
  bool is_simple(const CellBlock& block) const {
    const Eye& eye = judge_.eye_;
    if (eye.target_absolute || judge_.shadow_) return false;
    const double west = centres_.x[block.column] - eye.units.x, east = centres_.x[block.column_end - 1] - eye.units.x,
                 north = centres_.y[block.row] - eye.units.y, south = centres_.y[block.row_end - 1] - eye.units.y;
    const double x = std::max({west, -east, 0.0}), y = std::max({south, -north, 0.0});
    const double far_x = std::max(-west, east), far_y = std::max(north, -south);
    const double square_metres = resolution_ * resolution_;
    // The eye's own place lies in no such block.
    return x + y > 1 &&
           eye.view.holds((x * x + y * y) * square_metres * (1 - 1e-9),
                          (far_x * far_x + far_y * far_y) * square_metres * (1 + 1e-9)) &&
           judge_.surface_.bounds().covers(box_of(block));
  }

  /// Judges cells by rules of their own, in blocks that have cells with such rules.
  void judge_cells(const CellBlock& block, const TileValues<Verdict>& asked, TileValues<Verdict>& values) {
    if (is_simple(block)) return;
    if (judge_.surface_.bounds().highest(box_of(block)) == -kFloatInfinity)
      return decide(block, Verdict::kOutside, asked, values);
    if (block.side() > kCellByCell)
      return for_each_quarter(block, [&](const CellBlock& quarter) { judge_cells(quarter, asked, values); });
    const Heights& heights = this->heights();
    for_each_cell(block, [&](std::size_t cell) {
      const auto row = static_cast<std::int64_t>(cell) / Tile::kSide,
                 column = static_cast<std::int64_t>(cell) % Tile::kSide;
      if (asked[cell] == Verdict::kUndecided)
        values[cell] =
            verdict_of_cell(judge_.grid_.centre(tile_.column + column, tile_.row + row), cell, heights, values[cell]);
    });
  }
  Verdict verdict_of_cell(Point2 centre, std::size_t cell, const Heights& heights, Verdict known) const {
    const Point2 place = centres_.at(cell);
    const BoundedTarget target =
        bounded_target(judge_.eye_, centre, place, heights.low[cell] * resolution_, heights.high[cell] * resolution_);
    if (target.verdict != Verdict::kUndecided || !target.in_view) return target.verdict;
    return judge_.shadow_ && judge_.shadow_->holds(place.x, place.y) ? Verdict::kHidden : known;
  }

  void take_nearby(const TileValues<Verdict>& asked, TileValues<Verdict>& values) const {
    const ExactNearby& nearby = *judge_.nearby_;
    if (tile_.column >= nearby.first.column + nearby.columns || tile_.column + tile_.columns <= nearby.first.column ||
        tile_.row >= nearby.first.row + nearby.rows || tile_.row + tile_.rows <= nearby.first.row)
      return;
    for_each_cell(tile_, [&](std::size_t cell, RasterGrid::Cell place) {
      const Verdict exact = nearby.at(place);
      if (asked[cell] == Verdict::kUndecided && exact != Verdict::kOutside) values[cell] = exact;
    });
  }

  const Heights& heights() {
    if (!heights_) {
      heights_ = std::make_unique<Heights>();
      const auto triangles = judge_.surface_.triangles().triangles(number_);
      scan_convert(judge_.surface_.envelope().lower, triangles, tile_, centres_, heights_->low);
      scan_convert_highest(judge_.surface_.envelope().upper, triangles, tile_, centres_, heights_->high);
      for_each_cell(all_, [&](std::size_t cell) {
        const std::size_t row = cell / Tile::kSide, column = cell % Tile::kSide;
        heights_->high[cell] += judge_.surface_.rises().over(tile_, {row, row + 1, column, column + 1});
      });
    }
    return *heights_;
  }

  static constexpr double kSmallest = 1.5;       ///< bins: what lies closer together shares nearly all that is known
  static constexpr std::size_t kCellByCell = 8;  ///< cells along a block that is judged cell by cell

  const BlockJudge& judge_;
  std::size_t number_;
  Tile tile_;
  double resolution_;  ///< metres of a grid unit
  TileCentres centres_;
  CellBlock all_;
  std::unique_ptr<Heights> heights_;
  TileValues<double> low_, high_;
};

namespace {

HorizonView horizon_of(const EnvelopeBounds& bounds, const Request& request, const Eye& eye) {
  const double resolution = bounds.units().resolution;
  const auto axis = HorizonView::axis_at(bounds, eye.units, eye.view.farthest() / resolution + 1);
  HorizonView view(bounds, axis, request.earth.drop_coefficient() * resolution, kGrazing / resolution);
  view.advance(kInfinity);
  return view;
}

}  // namespace

BlockJudge::BlockJudge(const BoundedEnvelope& surface, const Request& request, const RasterGrid& grid,
                       const RasterGrid& tiles, const Eye& eye, const ExactNearby* nearby)
    : surface_(surface),
      grid_(grid),
      tiles_(tiles),
      eye_(eye),
      nearby_(nearby),
      horizon_(horizon_of(surface.bounds(), request, eye)) {
  if (request.nodata == NoData::kBlock)
    shadow_.emplace(rim_of(surface.envelope().upper, surface.envelope().outline), eye.units);
}

bool BlockJudge::may_see(const Box& ground) const {
  const EnvelopeBounds& bounds = surface_.bounds();
  const BinBox box = bounds.in_bins(ground);
  const double resolution = bounds.units().resolution, highest = bounds.highest(box) * resolution;
  return !horizon_.hides(box, std::max(highest, eye_.target(highest)) / resolution);
}

std::unique_ptr<TileJudge::Work> BlockJudge::begin(std::size_t tile) const {
  return std::make_unique<BlockWork>(*this, tile);
}

}  // namespace itin::viewshed
