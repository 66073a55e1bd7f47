#include "modes/observation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "line/infinity.hpp"
#include "line/tile_parts.hpp"
#include "modes/blocker_observation.hpp"
#include "modes/least_height_observation.hpp"
#include "modes/level_observation.hpp"
#include "modes/loss_observation.hpp"
#include "modes/mode_values.hpp"
#include "modes/probability_observation.hpp"
#include "modes/zone_observation.hpp"
#include "request/field_of_view.hpp"

namespace itin::viewshed {

namespace {

/// After so many cells it is looked whether the call is cancelled.
constexpr std::size_t kCellsPerLook = 4;

constexpr float kNoAngle = std::numeric_limits<float>::quiet_NaN();

class AnyObserver final : public Observation {
 public:
  bool open(const CellView& view) const override { return verdicts().open(view.cell); }
};

class ObserverCount final : public Observation {
 public:
  ObserverCount() { counts_.fill(0); }

 private:
  void keep(const CellView& view) override { ++counts_[view.cell]; }
  void store_row(const StoredRow& row, Result& result) const override {
    auto& counts = result.get<Counts>().count;
    row.for_each([&](std::size_t cell, std::size_t place) {
      counts[place] = verdicts()[cell] == Verdict::kOutside ? kCountOutside : counts_[cell];
    });
  }
  TileValues<std::uint16_t> counts_;
};

class ObserverBits final : public Observation {
 public:
  explicit ObserverBits(std::size_t observers) : grids_(bit_grids(observers)) {}

 private:
  void keep(const CellView& view) override {
    const RasterBit bit = raster_bit(view.observer);
    std::vector<std::uint32_t>& row = rows_[view.cell / Tile::kSide];
    const std::size_t words = view.cell % Tile::kSide * grids_;
    if (row.size() <= words) row.resize(words + grids_);
    row[words + bit.grid] |= bit.mask;
  }
  void store_row(const StoredRow& row, Result& result) const override {
    auto& words = result.get<ObserverSets>().words;
    const std::vector<std::uint32_t>& of_row = rows_[row.cell / Tile::kSide];
    StoredRow seen = row;
    seen.columns = std::min(row.columns, of_row.size() / grids_);  // beyond, the result's words are 0
    seen.for_each([&](std::size_t cell, std::size_t place) {
      for (std::size_t grid = 0; grid < grids_; ++grid)
        words[grid * result.grid.cell_count() + place] = of_row[cell % Tile::kSide * grids_ + grid];
    });
  }
  std::size_t grids_;
  /// Each of the tile's rows has the words of its cells, cell by cell, up to the last that is seen.
  std::array<std::vector<std::uint32_t>, Tile::kSide> rows_;
};

class GreatestAngle final : public Observation {
 public:
  explicit GreatestAngle(const Request& request) : view_(request, {}) { angles_.fill(kNoAngle); }

 private:
  void keep(const CellView& view) override {
    const auto angle = static_cast<float>(view_.elevation(view.dx, view.dy, view.dz));
    if (!(angles_[view.cell] >= angle)) angles_[view.cell] = angle;
  }
  void store_row(const StoredRow& row, Result& result) const override {
    row.for_each([&](std::size_t cell, std::size_t place) { result.get<Angles>().angle_deg[place] = angles_[cell]; });
  }
  FieldOfView view_;
  TileValues<float> angles_;
};

class NearestObserver final : public Observation {
 public:
  NearestObserver() {
    squared_.fill(kInfinity);
    numbers_.fill(0);
  }
  bool open(const CellView& view) const override {
    // The first of two that are equally near counts.
    const double squared = view.squared_distance();
    return squared < squared_[view.cell] || (squared == squared_[view.cell] && view.observer + 1 < numbers_[view.cell]);
  }

 private:
  void keep(const CellView& view) override {
    squared_[view.cell] = view.squared_distance();
    numbers_[view.cell] = view.observer + 1;
  }
  void store_row(const StoredRow& row, Result& result) const override {
    auto& nearest = result.get<NearestObservers>();
    row.for_each([&](std::size_t cell, std::size_t place) {
      nearest.number[place] = numbers_[cell];
      nearest.distance_m[place] = numbers_[cell] != 0 ? static_cast<float>(std::sqrt(squared_[cell])) : kNoAngle;
    });
  }
  TileValues<double> squared_;
  TileValues<std::uint32_t> numbers_;
};

}  // namespace

std::uint64_t Observation::hide(const Tile& tile, std::span<const Tile> parts) {
  for_each_cell(parts, tile, [&](std::size_t cell) { verdicts_.add(cell, Verdict::kHidden); });
  return cell_count(parts);
}

std::uint64_t Observation::observe(const TileView& tile) {
  const ExactScene::TileCells& cells = tile.cells();
  const Eye& eye = tile.eye();
  if (cells.unread) {
    const MapView view_of_eye{eye.position, eye.view};
    const bool all = view_of_eye.holds(box_of_centres(tile.work.surface().grid(), cells.tile));
    tile.for_each_cell([&](const CellView& view) {
      if (all || eye.view.contains(view.dx, view.dy, view.dz)) verdicts_.add(view.cell, Verdict::kHidden);
    });
    return 0;
  }
  TileValues<Verdict> values;
  values.fill(Verdict::kOutside);
  tile.for_each_cell([&](const CellView& view) {
    if (open(view)) values[view.cell] = Verdict::kUndecided;
  });
  const std::uint64_t lines = tile.work.judge(tile.number, values);
  qualify(tile, values);
  verdicts_.add(values);
  tile.for_each_cell([&](CellView view) {
    const Verdict verdict = values[view.cell];
    if (verdict == Verdict::kOutside) return;
    view.dz = eye.target(cells.ground[view.cell] * tile.resolution()) - eye.elevation;
    if (!std::isnan(cells.targets[view.cell])) {
      if (view.cell % kCellsPerLook == 0) tile.progress.throw_if_cancelled();
      study(tile, view, {eye, eye.units, cells.target(view.cell), verdict});
    } else if (verdict == Verdict::kVisible) {
      keep(view);
    }
  });
  return lines;
}

void Observation::store(const Tile& tile, Result& result, CellCounts& cells) const {
  verdicts_.store(tile, result, cells);
  for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell first) {
    store_row(
        {cell, static_cast<std::size_t>(tile.columns), result.grid.index(first), static_cast<std::size_t>(tile.step)},
        result);
  });
}

void Observation::prepare(Result& result) {
  result.visible.assign(result.grid.cell_count(), Verdict::kOutside);
  result.values = values_outside(result.request, result.grid.cell_count());
}

void Observations::finish(Result& result) const {
  if (request_.mode == Mode::kBlocker) blockers_.give(result);
}

std::unique_ptr<Observation> Observations::of_tile() {
  switch (request_.mode) {
    case Mode::kCount:
      return std::make_unique<ObserverCount>();
    case Mode::kWhich:
      return std::make_unique<ObserverBits>(request_.observers.size());
    case Mode::kAngle:
      return std::make_unique<GreatestAngle>(request_);
    case Mode::kNearest:
      return std::make_unique<NearestObserver>();
    case Mode::kBlocker:
      return std::make_unique<BlockerObservation>(blockers_);
    case Mode::kHeight:
      return std::make_unique<LeastHeightObservation>();
    case Mode::kProbability:
      return std::make_unique<ProbabilityObservation>();
    case Mode::kFresnel:
      return std::make_unique<ZoneObservation>();
    case Mode::kLoss:
      return std::make_unique<LossObservation>(request_.nodata);
    case Mode::kLevel:
      return std::make_unique<LevelObservation>(request_);
    case Mode::kVisible:
      break;
  }
  return std::make_unique<AnyObserver>();
}

}  // namespace itin::viewshed
