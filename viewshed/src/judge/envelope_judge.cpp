#include "judge/envelope_judge.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <itin/grazing.hpp>
#include <itin/parallel.hpp>

#include "bounds/cell_blocks.hpp"
#include "bounds/surface_heights.hpp"
#include "judge/bounded_target.hpp"
#include "line/infinity.hpp"
#include "line/set_bits.hpp"

namespace itin::viewshed {

namespace {

/// Cells along the side of the smallest block that is hidden as a whole.
constexpr std::size_t kBlockSide = 8, kBlocks = Tile::kSide / kBlockSide;
/// One value per block of a tile, row by row.
using BlockValues = std::array<double, kBlocks * kBlocks>;

BlockValues highest_by_block(const TileValues<double>& heights, const Tile& tile) {
  BlockValues highest;
  highest.fill(-kInfinity);
  for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell) {
    const std::size_t r = cell / Tile::kSide, c = cell % Tile::kSide;
    const std::size_t block = r / kBlockSide * kBlocks + c / kBlockSide;
    // The height is NaN where there is no surface, and then not higher than anything.
    if (heights[cell] > highest[block]) highest[block] = heights[cell];
  });
  return highest;
}

}  // namespace

class EnvelopeJudge::EnvelopeWork final : public TileJudge::Work {
 public:
  EnvelopeWork(const EnvelopeJudge& judge, std::size_t number)
      : judge_(judge),
        scene_(judge.scene_),
        number_(number),
        tile_(tile_at(judge.grid_, judge.tiles_, number)),
        rows_(static_cast<std::size_t>(tile_.rows)),
        columns_(static_cast<std::size_t>(tile_.columns)),
        resolution_(scene_.envelope.lower.grid.resolution),
        metre_(1 / resolution_),
        centres_(scene_.envelope.lower.grid, judge.grid_, tile_) {
    const auto triangles = scene_.bins.triangles(number);
    scan_convert(scene_.envelope.lower, triangles, tile_, centres_, low_);
    scan_convert_highest(scene_.envelope.upper, triangles, tile_, centres_, high_);
    highest_ = highest_by_block(high_, tile_);
  }

  std::uint64_t judge(std::size_t eye, TileValues<Verdict>& values) override {
    if (std::find(values.begin(), values.end(), Verdict::kUndecided) == values.end()) return 0;
    view_ = &judge_.view(eye);
    lines_ = 0;
    hide_quarters(0, 0, Tile::kSide / 2, values);
    for (std::size_t row = 0; row < rows_; row += kPacketSide)
      for (std::size_t column = 0; column < columns_; column += kPacketSide) judge_packet(row, column, values);
    return lines_;
  }

  TileTargets targets() override {
    for (std::size_t cell = 0; cell < low_.size(); ++cell) {
      low_targets_[cell] = target(low_[cell]);
      high_targets_[cell] = target(high_[cell]);
    }
    return {centres_, low_targets_, high_targets_};
  }

 private:
  /// The target's elevation on this ground, grid units, by the arithmetic of plain viewsheds to the last bit.
  double target(double ground) const { return view_->eye.target(ground * resolution_) * metre_; }

  /// Hides what it can of the four blocks of this side, or of their quarters: most of what an observer on the ground
  /// looks at is hidden, and a triangle nearer by hides many cells.
  void hide_quarters(std::size_t row, std::size_t column, std::size_t side, TileValues<Verdict>& values) {
    SightLines lines;
    lines.start_at(view_->eye.units);
    std::array<CellBlock, 4> blocks{};
    for (unsigned q = 0; q < 4; ++q) {
      const std::size_t r = row + q / 2 * side, c = column + q % 2 * side;
      if (r >= rows_ || c >= columns_) continue;
      blocks[q] = {r, std::min(r + side, rows_), c, std::min(c + side, columns_)};
      aim_at_corners(blocks[q], 4 * q, lines);
    }
    const unsigned hidden = lines.active == 0 ? 0 : scene_.lower.hidden_together(lines, occluder_);
    lines_ += static_cast<unsigned>(std::popcount(lines.active));
    for (unsigned q = 0; q < 4; ++q) {
      const CellBlock& block = blocks[q];
      if (block.row_end == 0) continue;
      if ((hidden >> q & 1) != 0) {
        hide(block, values);
      } else if (side > kBlockSide) {
        hide_quarters(block.row, block.column, side / 2, values);
      }
    }
  }

  void hide(const CellBlock& block, TileValues<Verdict>& values) const {
    for_each_cell(block, [&](std::size_t cell) {
      if (values[cell] == Verdict::kUndecided)
        values[cell] = std::isnan(low_[cell]) ? Verdict::kOutside : Verdict::kHidden;
    });
  }

  double highest_of(const CellBlock& block) const {
    double highest = -kInfinity;
    for (std::size_t r = block.row / kBlockSide; r <= (block.row_end - 1) / kBlockSide; ++r)
      for (std::size_t c = block.column / kBlockSide; c <= (block.column_end - 1) / kBlockSide; ++c)
        highest = std::max(highest, highest_[r * kBlocks + c]);
    return highest;
  }

  /// Aims four lines, the first of them number `first`, at the corners of a flat piece above all targets of the block.
  /// Aims none where that cannot hide the block as a whole.
  void aim_at_corners(const CellBlock& block, unsigned first, SightLines& lines) const {
    const Eye& eye = view_->eye;
    const double highest = highest_of(block);
    if (!std::isfinite(highest)) return;
    const double west = centres_.x[block.column], east = centres_.x[block.column_end - 1];
    const double north = centres_.y[block.row], south = centres_.y[block.row_end - 1];
    const auto squared = [&](double x, double y) {
      return (x - eye.units.x) * (x - eye.units.x) + (y - eye.units.y) * (y - eye.units.y);
    };
    const Point2 near{std::clamp(eye.units.x, west, east), std::clamp(eye.units.y, south, north)};
    const double nearest = squared(near.x, near.y);
    double farthest = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const double x = i % 2 == 0 ? west : east, y = i < 2 ? north : south, distance = squared(x, y);
      farthest = std::max(farthest, distance);
      // The piece is level as the eye sees it: as far below the eye as the highest target would be at the nearest
      // place. Rounding is far less than what a line must be hidden by.
      lines.to_x[first + i] = x;
      lines.to_y[first + i] = y;
      lines.to_z[first + i] =
          (eye.target(highest * resolution_) + 4 * kGrazing) / resolution_ + scene_.drop * (distance - nearest);
    }
    const double squared_metre = resolution_ * resolution_;
    if (eye.stands_at(near) || !eye.view.holds(nearest * squared_metre, farthest * squared_metre)) return;
    lines.active |= 0xfU << first;
  }

  void judge_packet(std::size_t row, std::size_t column, TileValues<Verdict>& values) {
    EnvelopePacket packet(view_->eye);
    const auto cell_of = [&](unsigned i) { return (row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide; };
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      Verdict& value = values[cell_of(i)];
      if (value == Verdict::kUndecided) value = aim(cell_of(i), i, packet);
    }
    if (packet.low.active == 0) return;
    const EnvelopeScene::Decided decided = scene_.decide(packet);
    lines_ += decided.lines;
    for_each_bit(decided.visible, [&](unsigned i) { values[cell_of(i)] = Verdict::kVisible; });
    for_each_bit(decided.hidden, [&](unsigned i) { values[cell_of(i)] = Verdict::kHidden; });
    if (packet.low.active != 0 && judge_.on_undecided_) judge_.on_undecided_(number_, packet);
  }

  /// Aims a line at the cell's target, unless the cell is decided without a line.
  Verdict aim(std::size_t cell, unsigned i, EnvelopePacket& packet) const {
    const Point2 place = centres_.at(cell);
    const BoundedTarget target =
        bounded_target(view_->eye, metres_of(cell), place, low_[cell] * resolution_, high_[cell] * resolution_);
    if (target.verdict != Verdict::kUndecided) return target.verdict;
    if (view_->shadow && view_->shadow->holds(place.x, place.y)) {
      if (scene_.rule == NoData::kBlock && target.in_view) return Verdict::kHidden;
      packet.behind_void |= 1U << i;
    }
    if (!target.in_view) packet.perhaps_outside |= 1U << i;
    packet.aim(i, {place, target.low * metre_, target.high * metre_});
    return Verdict::kUndecided;
  }

  Point2 metres_of(std::size_t cell) const {
    return judge_.grid_.centre(tile_.column + static_cast<std::int64_t>(cell % Tile::kSide),
                               tile_.row + static_cast<std::int64_t>(cell / Tile::kSide));
  }

  const EnvelopeJudge& judge_;
  const EnvelopeScene& scene_;
  std::size_t number_;
  Tile tile_;
  std::size_t rows_, columns_;  ///< how many cells the tile has
  double resolution_, metre_;   ///< grid units in metres, and the other way round
  TileCentres centres_;
  TileValues<double> low_;   ///< the least height of what targets stand on, grid units
  TileValues<double> high_;  ///< the upper surface
  BlockValues highest_;      ///< the highest place of targets in each block; -infinity where there is no surface
  // These belong to the eye that was judged last.
  const EnvelopeScene::View* view_ = nullptr;
  TileValues<double> low_targets_, high_targets_;
  Occluder occluder_;
  std::uint64_t lines_ = 0;
};

EnvelopeJudge::EnvelopeJudge(const EnvelopeScene& scene, const RasterGrid& grid, const RasterGrid& tiles,
                             const std::vector<Eye>& eyes, OnUndecided on_undecided)
    : scene_(scene), grid_(grid), tiles_(tiles), views_(eyes.size()), on_undecided_(std::move(on_undecided)) {
  parallel_for(eyes.size(), [&](std::size_t i) { views_[i] = scene.view_from(eyes[i]); });
}

std::unique_ptr<TileJudge::Work> EnvelopeJudge::begin(std::size_t tile) const {
  return std::make_unique<EnvelopeWork>(*this, tile);
}

}  // namespace itin::viewshed
