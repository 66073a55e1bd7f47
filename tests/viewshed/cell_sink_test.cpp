// What a sink gets of a viewshed while it is computed is what the result has in the end.
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/held_surface.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/level_source.hpp"
#include "exact/lattice_sectors.hpp"
#include "exact/tin_segments.hpp"
#include "line/cell_tiles.hpp"
#include "modes/mode_values.hpp"
#include "support/hills_and_town.hpp"
#include "support/same_result.hpp"

namespace itin::viewshed {
namespace {

/// Copies what the values of a mode tell of one cell.
class CellCopy {
 public:
  CellCopy(std::size_t cell, std::size_t cells) : cell_(cell), cells_(cells) {}

  void operator()(std::monostate, std::monostate) const {}
  void operator()(const Counts& from, Counts& to) const { copy(from.count, to.count); }
  void operator()(const ObserverSets& from, ObserverSets& to) const { copy(from.words, to.words); }
  void operator()(const Angles& from, Angles& to) const { copy(from.angle_deg, to.angle_deg); }
  void operator()(const NearestObservers& from, NearestObservers& to) const {
    copy(from.number, to.number);
    copy(from.distance_m, to.distance_m);
  }
  /// Blockers are numbered at the end.
  void operator()(const Blockers&, Blockers&) const {}
  void operator()(const LeastHeights& from, LeastHeights& to) const { copy(from.height_m, to.height_m); }
  void operator()(const Probabilities& from, Probabilities& to) const { copy(from.probability, to.probability); }
  void operator()(const Losses& from, Losses& to) const {
    copy(from.diffraction_db, to.diffraction_db);
    copy(from.free_space_db, to.free_space_db);
  }
  void operator()(const Levels& from, Levels& to) const {
    copy(from.level_dbm, to.level_dbm);
    copy(from.outage_minutes, to.outage_minutes);
    copy(from.observer, to.observer);
  }
  template <class A, class B>
  void operator()(const A&, const B&) const {
    ADD_FAILURE() << "the values are of different modes";
  }

 private:
  /// A cell of several grids has a value in each.
  template <class T>
  void copy(const std::vector<T>& from, std::vector<T>& to) const {
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t i = cell_; i < from.size(); i += cells_) to[i] = from[i];
  }

  std::size_t cell_, cells_;
};

/// The cells of one pass, as they came.
struct ReceivedPass {
  std::vector<int> times;
  std::vector<Verdict> verdicts;
  ModeValues values;

  void begin(const Result& result) {
    if (!times.empty()) return;
    times.resize(result.grid.cell_count());
    verdicts.resize(times.size(), Verdict::kOutside);
    values = values_outside(result.request, times.size());
  }
  void take(const Result& result, std::size_t cell) {
    ++times[cell];
    verdicts[cell] = result.visible[cell];
    std::visit(CellCopy(cell, times.size()), result.values, values);
  }
  /// Expects what came to be what the result has there.
  void expect_is_part_of(const Result& result) const {
    ASSERT_EQ(times.size(), result.grid.cell_count());
    ModeValues expected = values_outside(result.request, times.size());
    for (std::size_t cell = 0; cell < times.size(); ++cell) {
      ASSERT_LE(times[cell], 1) << cell;
      if (times[cell] == 0) continue;
      ASSERT_EQ(verdicts[cell], result.visible[cell]) << cell;
      std::visit(CellCopy(cell, times.size()), result.values, expected);
    }
    EXPECT_TRUE(test::same_values(values, expected));
  }
};

/// Keeps what blocks hold when they come.
class Received {
 public:
  CellSink sink() {
    return [this](const Result& result, const DecidedCells& block) { take(result, block); };
  }
  /// Calls done() once the sink has been called so often.
  CellSink sink(std::size_t calls, const std::function<void()>& done) {
    return [this, calls, done](const Result& result, const DecidedCells& block) {
      take(result, block);
      if (steps_.size() == calls) done();
    };
  }

  /// Expects that all passes came, and that each holds what the result has in the end.
  void expect_is(const Result& result, std::span<const std::int64_t> steps) const {
    for (const std::int64_t step : steps) {
      SCOPED_TRACE(step);
      ASSERT_TRUE(passes_.contains(step));
      const ReceivedPass& pass = passes_.at(step);
      pass.expect_is_part_of(result);
      const SteppedTiles tiles(result.grid, step);
      for (std::size_t i = 0; i < tiles.count(); ++i)
        for_each_cell(tiles.tile(i), [&](std::size_t, RasterGrid::Cell place) {
          const std::size_t cell = result.grid.index(place);
          ASSERT_TRUE(pass.times[cell] == 1 || result.visible[cell] == Verdict::kOutside) << cell;
        });
    }
    EXPECT_EQ(passes_.size(), steps.size());
    expect_is_part_of(result);
  }
  void expect_is_part_of(const Result& result) const {
    for (const auto& [step, pass] : passes_) pass.expect_is_part_of(result);
  }

  /// The step of each block, in the order in which they came.
  const std::vector<std::int64_t>& steps() const { return steps_; }
  /// How far each block was from the first observer.
  const std::vector<double>& distances() const { return distances_; }

 private:
  void take(const Result& result, const DecidedCells& block) {
    ReceivedPass& pass = passes_[block.step];
    pass.begin(result);
    for (std::int64_t row = 0; row < block.rows; ++row)
      for (std::int64_t column = 0; column < block.columns; ++column)
        pass.take(result, result.grid.index(block.at(column, row)));
    steps_.push_back(block.step);
    Box box = box_of_cell(result.grid, block.north_west);
    box.extend(box_of_cell(result.grid, block.at(block.columns - 1, block.rows - 1)));
    distances_.push_back(std::sqrt(squared_distance(result.request.observers.front().position, box)));
  }

  std::map<std::int64_t, ReceivedPass> passes_;  ///< by their steps
  std::vector<std::int64_t> steps_;
  std::vector<double> distances_;
};

constexpr std::int64_t kAtOnce[] = {9, 3, 1}, kInPieces[] = {1};

class CellSinks : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }

  /// Computes with a sink, and expects the result that comes without one.
  void expect_same(const Store& store, const Request& request, ComputeOptions options) {
    const Result without = compute_with_surface(store, request, options, progress_).result;
    Received received;
    options.sink = received.sink();
    const Result with = compute_with_surface(store, request, options, progress_).result;
    test::expect_same_result(without, with);
    received.expect_is(with, kAtOnce);
  }

  /// Stops after some blocks, and expects the blocks that came to be what a whole result has.
  void expect_right_until_stopped(const HeldSurface& surface, const Request& request) {
    const Result whole = surface.compute(request, progress_);
    for (const std::size_t calls : {1, 2, 4}) {
      SCOPED_TRACE(calls);
      StoppedAtWill progress;
      Received received;
      const CellSink sink = received.sink(calls, [&] { progress.stop(); });
      EXPECT_THROW(std::ignore = surface.compute(request, progress, sink), Cancelled);
      received.expect_is_part_of(whole);
      EXPECT_GE(received.steps().size(), calls);
    }
  }

  class StoppedAtWill final : public Progress {
   public:
    void stop() { stopped_ = true; }
    void report(std::string_view, double) override {}
    bool cancelled() const override { return stopped_; }

   private:
    std::atomic<bool> stopped_ = false;
  };

  static inline test::HillsAndTown* stores_ = nullptr;
  NoProgress progress_;
};

TEST_F(CellSinks, GetEveryCellOfEveryModeOnceInEachPass) {
  const Store hills(stores_->hills()), town(stores_->town());
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    Request over_hills = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_hills()),
            over_town = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_town());
    over_hills.cell_size = 39, over_town.cell_size = 9;
    expect_same(hills, over_hills, {});
    expect_same(town, over_town, {});
  }
}

TEST_F(CellSinks, GetWhatIsDecidedPieceByPiece) {
  const Store hills(stores_->hills());
  const Request request = test::HillsAndTown::over_hills();
  const Result whole = compute(hills, request, progress_);
  Received by_sectors, by_segments, certified;
  const auto sectors = compute_by_lattice_sectors(hills, request, 800000, by_sectors.sink(), progress_);
  ASSERT_TRUE(sectors);
  test::expect_same_result(whole, sectors->result);
  by_sectors.expect_is(sectors->result, kInPieces);

  const Result segments = compute_in_tin_segments(hills, request, 8000000, by_segments.sink(), progress_).result;
  test::expect_same_result(whole, segments);
  by_segments.expect_is(segments, kInPieces);

  Request coarse = request;
  coarse.detail = Detail::tolerance(8);
  certified.expect_is(certify_by_blocks(hills, coarse, certified.sink(), progress_).result, kInPieces);
}

TEST_F(CellSinks, GetOverHeldSurfacesWhatComesWithoutThem) {
  const Store hills(stores_->hills()), town(stores_->town());
  const auto held = [&](const Store& store) {
    return HeldSurface(store, extent_of(store), Detail::tolerance(0), ThemeChoice::all(), {}, progress_);
  };
  const HeldSurface over_hills = held(hills), over_town = held(town);
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    for (const bool in_town : {false, true}) {
      const HeldSurface& surface = in_town ? over_town : over_hills;
      Request request = test::HillsAndTown::in_mode(
          mode, in_town ? test::HillsAndTown::over_town() : test::HillsAndTown::over_hills());
      request.cell_size = in_town ? 4.3 : 29.0;
      Received received;
      const Result with = surface.compute(request, progress_, received.sink());
      test::expect_same_result(surface.compute(request, progress_), with);
      received.expect_is(with, kAtOnce);
      expect_right_until_stopped(surface, request);
    }
  }
}

/// Counts how often it is asked, and is cancelled from some time on.
class Asked final : public Progress {
 public:
  explicit Asked(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return ++times_ > most_; }
  std::size_t times() const { return times_; }

 private:
  std::size_t most_;
  mutable std::atomic<std::size_t> times_ = 0;
};

/// A single tile takes tens of milliseconds in modes that ask much of each line; the call must not wait for its end.
TEST_F(CellSinks, AreNotAwaitedTileByTile) {
  const Store hills(stores_->hills());
  const HeldSurface surface(hills, extent_of(hills), Detail::tolerance(0), ThemeChoice::none(), {}, progress_);
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    Request request = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_hills());
    request.observers.resize(1);
    request.cell_size = 100;
    std::ignore = surface.compute(request, progress_);  // lists triangles, in some modes
    Asked to_the_end;
    std::ignore = surface.compute(request, to_the_end);
    EXPECT_GT(to_the_end.times(), 60U) << "the horizon and each few cells ask";
    for (const std::size_t part : {1, 2, 5, 9}) {
      Asked stopped(to_the_end.times() * part / 10);
      EXPECT_THROW(std::ignore = surface.compute(request, stopped), Cancelled);
      EXPECT_LE(stopped.times(), to_the_end.times() * part / 10 + 100);
    }
  }
}

TEST_F(CellSinks, GetTheNearestCellsFirst) {
  const Store hills(stores_->hills());
  const HeldSurface surface(hills, {301500, 200200, 303800, 203800}, Detail::tolerance(0), ThemeChoice::none(), {},
                            progress_);
  Request request;
  request.observers = {{"o", {302650, 202000}, 10}};
  request.radius = 1100;
  request.cell_size = 5;
  const ThreadLimit one(1);
  Received received;
  received.expect_is(surface.compute(request, progress_, received.sink()), kAtOnce);
  ASSERT_GT(received.distances().size(), 15U);
  for (std::size_t i = 1; i < received.distances().size(); ++i) {
    const std::int64_t before = received.steps()[i - 1], now = received.steps()[i];
    EXPECT_GE(before, now);
    if (before == now) {
      EXPECT_GE(received.distances()[i], received.distances()[i - 1]);
    }
  }
}

/// However the observer moves, and so the raster, a coarse pass looks at the same places.
TEST_F(CellSinks, GetCoarseCellsWhoseCentresStay) {
  const Store hills(stores_->hills());
  for (const double moved : {0.0, 5.0, 40.0, 155.0}) {
    Request request;
    request.observers = {{"o", {302650 + moved, 202000 - 2 * moved}, 10}};
    request.radius = 300;
    request.cell_size = 5;
    ComputeOptions options;
    options.sink = [](const Result& result, const DecidedCells& block) {
      const Point2 centre = result.grid.centre(block.north_west.column, block.north_west.row);
      const double side = 5 * static_cast<double>(block.step);
      EXPECT_EQ(std::fmod(centre.x, side), side / 2);
      EXPECT_EQ(std::fmod(centre.y, side), side / 2);
    };
    std::ignore = compute_with_surface(hills, request, options, progress_);
  }
}

}  // namespace
}  // namespace itin::viewshed
