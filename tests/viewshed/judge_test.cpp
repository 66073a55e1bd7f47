// Judges of one interface: the surface itself, and two surfaces that enclose it, which never contradict it; and what
// several eyes say of a cell, made one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/result.hpp>

#include "bounds/boundary.hpp"
#include "judge/envelope_judge.hpp"
#include "judge/exact_judge.hpp"
#include "line/set_bits.hpp"
#include "line/verdicts.hpp"
#include "modes/observation.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

class Judges : public testing::Test {
 protected:
  static constexpr int kSide = 65;
  static constexpr double kStep = 20;

  Judges()
      : tin_(test::fractal_tin(kSide, kStep, 120, 0.6, random_())),
        grid_(RasterGrid::aligned(tin_.bounds(), 9)),
        tiles_(grid_of_tiles(grid_)),
        surface_(tin_, nullptr, request_.earth, grid_, tiles_) {
    std::uniform_real_distribution<double> share(0.05, 0.95);
    const Box box = tin_.bounds();
    for (int i = 0; i < 3; ++i) {
      const Point2 p{box.xmin + share(random_) * box.width(), box.ymin + share(random_) * box.height()};
      request_.observers.push_back({"", p, 3, false});
    }
    request_.target_height = 1;
    for (const Observer& observer : request_.observers)
      eyes_.push_back(eye_of(tin_.grid, request_, observer, surface_.height(observer.position)));
  }

  /// The surface, lowered and raised by so many metres.
  Envelope envelope(double metres) const {
    Envelope e;
    e.lower = e.upper = tin_;
    e.outline = boundary_edges(tin_);
    const auto units = static_cast<std::int32_t>(metres / tin_.grid.resolution);
    for (auto& v : e.lower.vertices) v.z -= units;
    for (auto& v : e.upper.vertices) v.z += units;
    return e;
  }

  std::vector<EyeView> views() const {
    return make_views(eyes_.size(), [&](std::size_t i) { return EyeView{eyes_[i], surface_.view_from(eyes_[i])}; });
  }

  /// Every cell of a tile for an eye.
  static TileValues<Verdict> all_of(const TileJudge& judge, std::size_t tile, std::size_t eye) {
    TileValues<Verdict> values;
    values.fill(Verdict::kUndecided);
    judge.begin(tile)->judge(eye, values);
    return values;
  }

  std::mt19937 random_{test::seed()};
  Request request_;
  Tin tin_;
  RasterGrid grid_, tiles_;
  ExactScene surface_;
  std::vector<Eye> eyes_;
};

TEST_F(Judges, BoundsNeverContradictTheSurface) {
  const ExactJudge exact(surface_, views());
  for (const double metres : {1.0, 6.0}) {
    const EnvelopeScene scene(envelope(metres), request_, tiles_, NoData::kClear);
    const EnvelopeJudge bounds(scene, grid_, tiles_, eyes_);
    std::size_t decided = 0;
    for (std::size_t tile = 0; tile < tiles_.cell_count(); ++tile) {
      for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
        const auto truth = all_of(exact, tile, eye), certain = all_of(bounds, tile, eye);
        for_each_cell(tile_at(grid_, tiles_, tile), [&](std::size_t cell, RasterGrid::Cell) {
          EXPECT_NE(truth[cell], Verdict::kUndecided);
          if (certain[cell] == Verdict::kUndecided) return;
          EXPECT_EQ(certain[cell], truth[cell]);
          ++decided;
        });
      }
    }
    EXPECT_GT(decided, grid_.cell_count() / 10) << metres;
  }
}

TEST_F(Judges, WhatStaysUndecidedIsTold) {
  const EnvelopeScene scene(envelope(2), request_, tiles_, NoData::kClear);
  std::mutex mutex;
  std::size_t told = 0, undecided = 0;
  const EnvelopeJudge judge(scene, grid_, tiles_, eyes_, [&](std::size_t tile, const EnvelopePacket& packet) {
    const std::lock_guard lock(mutex);
    EXPECT_LT(tile, tiles_.cell_count());
    for_each_bit(packet.low.active, [&](unsigned) { ++told; });
  });
  for (std::size_t tile = 0; tile < tiles_.cell_count(); ++tile) {
    const auto values = all_of(judge, tile, 0);
    for_each_cell(tile_at(grid_, tiles_, tile), [&](std::size_t cell, RasterGrid::Cell) {
      undecided += values[cell] == Verdict::kUndecided ? 1 : 0;
    });
  }
  EXPECT_EQ(told, undecided);
}

TEST_F(Judges, ATileIsBegunOnceAndOnlyIfAnythingIsAsked) {
  struct Counting final : TileJudge {
    explicit Counting(const TileJudge& of) : judge(of) {}
    std::unique_ptr<Work> begin(std::size_t tile) const override {
      ++begun;
      return judge.begin(tile);
    }
    const Eye& eye(std::size_t number) const override { return judge.eye(number); }
    const TileJudge& judge;
    mutable int begun = 0;
  };
  const ExactJudge exact(surface_, views());
  const Counting judge(exact);
  const auto close = [](std::size_t eye, const TileValues<Verdict>& values, TileJudge::Work&) {
    EXPECT_NE(eye, 1U);
    EXPECT_EQ(std::count(values.begin(), values.end(), Verdict::kUndecided), 0);
  };
  const auto nothing = [](std::size_t, TileValues<Verdict>&) { return false; };
  EXPECT_EQ(judge_tile(judge, 0, eyes_.size(), nothing, close), 0U);
  EXPECT_EQ(judge.begun, 0);
  const auto all_but_one = [](std::size_t eye, TileValues<Verdict>& values) {
    EXPECT_EQ(static_cast<std::size_t>(std::count(values.begin(), values.end(), Verdict::kOutside)), values.size());
    if (eye != 1) values.fill(Verdict::kUndecided);
    return eye != 1;
  };
  EXPECT_GT(judge_tile(judge, 0, eyes_.size(), all_but_one, close), 0U);
  EXPECT_EQ(judge.begun, 1);
}

/// Two ways to the same raster: verdicts added one judge's tile after another, and what a mode observes.
TEST_F(Judges, AModeKeepsTheVerdictsOfAllEyes) {
  const ExactJudge judge(surface_, views());
  request_.mode = Mode::kCount;
  Observations observations(request_);
  for (std::size_t tile = 0; tile < tiles_.cell_count(); ++tile) {
    Verdicts verdicts;
    const auto observation = observations.of_tile();
    const auto work = judge.begin_exactly(tile);
    TileValues<std::uint16_t> seen_by;
    seen_by.fill(0);
    for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
      const auto values = all_of(judge, tile, eye);
      verdicts.add(values);
      for (std::size_t cell = 0; cell < values.size(); ++cell) seen_by[cell] += values[cell] == Verdict::kVisible;
      observation->observe({*work, eye, static_cast<std::uint32_t>(eye), NoProgress()});
    }
    Result result;
    result.request = request_, result.grid = grid_;
    Observation::prepare(result);
    const Tile place = tile_at(grid_, tiles_, tile);
    observation->store(place, result, result.cells);
    Result expected = result;
    expected.cells = {};
    verdicts.store(place, expected, expected.cells);
    EXPECT_EQ(result.visible, expected.visible);
    EXPECT_EQ(result.cells.visible, expected.cells.visible);
    for_each_cell(place, [&](std::size_t cell, RasterGrid::Cell at) {
      const bool outside = verdicts[cell] == Verdict::kOutside;
      EXPECT_EQ(result.get<Counts>().count[grid_.index(at)], outside ? kCountOutside : seen_by[cell]);
    });
  }
}

/// Lattices and scattered points, each with a gap and with cells beyond the ground, looked at near and far.
TEST(HiddenTiles, HaveNoCellThatIsAnythingElse) {
  constexpr int kPosts = 129;
  constexpr double kSpacing = 20;
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> share(0.2, 0.8);
  std::size_t hidden = 0, others = 0;
  for (int round = 0; round < 24; ++round) {
    const std::vector<double> heights = test::fractal_heights(kPosts, 150, 0.6, random());
    const double gap_column = share(random) * kPosts, gap_row = share(random) * kPosts;
    Tin tin = test::lattice_tin(kPosts, kPosts, kSpacing, [&](std::int32_t c, std::int32_t r) {
      const bool in_gap = std::hypot(c - gap_column, r - gap_row) < 5;
      return in_gap ? std::numeric_limits<double>::quiet_NaN() : heights[static_cast<std::size_t>(r * kPosts + c)];
    });
    if (round % 2 == 0) tin.vertices[tin.vertices.size() / 2].x += 1;  // no lattice any more
    Request request;
    request.target_height = 2;
    request.target_absolute = round % 4 == 3;
    if (request.target_absolute) request.target_height = 20;
    if (round % 3 == 0) request.radius = 900;
    const Box box = tin.bounds();
    request.observers.push_back(
        {"", {box.xmin + share(random) * box.width(), box.ymin + share(random) * box.height()}, 3, false});
    const RasterGrid grid({box.xmin - 400, box.ymax + 400}, 5, 5, 680, 680);
    const RasterGrid tiles = grid_of_tiles(grid);
    const ExactScene surface(tin, nullptr, request.earth, grid, tiles);
    const auto ground = surface.height(request.observers.front().position);
    if (!ground) continue;
    const Eye eye = eye_of(tin.grid, request, request.observers.front(), ground);
    const ExactJudge judge(surface, EyeView{eye, surface.view_from(eye)});
    for (std::size_t tile = 0; tile < tiles.cell_count(); ++tile) {
      const bool all = judge.hides(0, tile_at(grid, tiles, tile));
      ++(all ? hidden : others);
      if (!all) continue;
      TileValues<Verdict> values;
      values.fill(Verdict::kUndecided);
      judge.begin(tile)->judge(0, values);
      for_each_cell(tile_at(grid, tiles, tile), [&](std::size_t cell, RasterGrid::Cell) {
        EXPECT_EQ(values[cell], Verdict::kHidden) << "round " << round << ", tile " << tile << ", cell " << cell;
      });
    }
  }
  EXPECT_GT(hidden, 20U);
  EXPECT_GT(others, hidden / 4);
}

TEST(Verdicts, TheFirstOfVisibleUndecidedHiddenAndOutsideCounts) {
  const std::array<Verdict, 4> ranks{Verdict::kVisible, Verdict::kUndecided, Verdict::kHidden, Verdict::kOutside};
  const auto rank = [&](Verdict v) { return std::find(ranks.begin(), ranks.end(), v) - ranks.begin(); };
  std::mt19937 random(test::seed());
  for (int round = 0; round < 200; ++round) {
    std::vector<Verdict> of_observers(std::uniform_int_distribution<std::size_t>(0, 5)(random));
    for (Verdict& v : of_observers) v = ranks[std::uniform_int_distribution<std::size_t>(0, 3)(random)];
    Verdicts verdicts;
    Verdict first = Verdict::kOutside;
    for (const Verdict v : of_observers) {
      verdicts.add(7, v);
      if (rank(v) < rank(first)) first = v;
    }
    EXPECT_EQ(verdicts[7], first);
    EXPECT_EQ(verdicts.open(7), first != Verdict::kVisible);
    EXPECT_EQ(verdicts[8], Verdict::kOutside);
  }
}

}  // namespace
}  // namespace itin::viewshed
