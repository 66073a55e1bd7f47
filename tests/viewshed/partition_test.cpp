// Parts are in order, leave nothing out, fit, and are no smaller than they must be.
#include "plan/partition.hpp"

#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "line/cell_tiles.hpp"
#include "plan/azimuth_order.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

using Costs = std::vector<std::uint64_t>;
using Some = std::span<const std::uint64_t>;

std::uint64_t sum_of(Some costs) {
  return std::accumulate(costs.begin(), costs.end(), std::uint64_t{0});
}

Costs random_costs(std::mt19937& random) {
  Costs costs(std::uniform_int_distribution<std::size_t>(1, 60)(random));
  for (std::uint64_t& cost : costs) cost = std::uniform_int_distribution<std::uint64_t>(0, 40)(random);
  return costs;
}

/// Cut until they cost at most so much; those of a single piece are kept as they are, or refused.
std::vector<Some> cut(const Costs& costs, std::uint64_t most, bool refuse) {
  return parts_that_fit(
      Some(costs), [&](Some part) { return sum_of(part) <= most || (!refuse && part.size() == 1); },
      [](Some part) {
        if (part.size() == 1) throw std::length_error("a piece does not fit");
        return halves(part);
      });
}

std::vector<Some> gathered(const Costs& costs, std::uint64_t most) {
  std::vector<Some> parts;
  for (Some left = costs; !left.empty(); left = left.subspan(parts.back().size())) {
    const auto run = longest_run(
        left.size(), std::uint64_t{0}, [&](std::uint64_t sum, std::size_t i) { return sum + left[i]; },
        [&](std::uint64_t sum) { return sum <= most; });
    EXPECT_EQ(run.sum, sum_of(left.first(run.count)));
    parts.push_back(left.first(run.count));
  }
  return parts;
}

void expect_parts(const Costs& costs, const std::vector<Some>& parts, std::uint64_t most) {
  const std::uint64_t* next = costs.data();
  for (const Some part : parts) {
    ASSERT_FALSE(part.empty());
    EXPECT_EQ(part.data(), next);
    next += part.size();
    EXPECT_TRUE(part.size() == 1 || sum_of(part) <= most);
  }
  EXPECT_EQ(next, costs.data() + costs.size());
}

TEST(Partition, EveryPartFitsAndNothingIsLeftOut) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 200; ++round) {
    const Costs costs = random_costs(random);
    const std::uint64_t most = std::uniform_int_distribution<std::uint64_t>(0, 200)(random);
    expect_parts(costs, cut(costs, most, false), most);
    const std::vector<Some> runs = gathered(costs, most);
    expect_parts(costs, runs, most);
    // As many as fit: the next piece would not.
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) EXPECT_GT(sum_of(runs[i]) + runs[i + 1].front(), most);
    EXPECT_LE(runs.size(), cut(costs, most, false).size());
  }
}

TEST(Partition, WhatFitsIsNotCut) {
  const Costs costs{3, 4, 5};
  EXPECT_EQ(cut(costs, 12, true).size(), 1U);
  EXPECT_EQ(gathered(costs, 12).size(), 1U);
  EXPECT_EQ(cut(costs, 11, true).size(), 2U);
}

TEST(Partition, APieceThatDoesNotFitAloneIsRefusedOrARunOfItsOwn) {
  const Costs costs{3, 20, 5};
  EXPECT_THROW(cut(costs, 10, true), std::length_error);
  EXPECT_EQ(cut(costs, 10, false).size(), 3U);
  EXPECT_EQ(gathered(costs, 10).size(), 3U);
  EXPECT_EQ(gathered({20}, 10).size(), 1U);
}

TEST(Partition, NoPieceIsNoRun) {
  const auto run = longest_run(
      0, 7, [](int sum, std::size_t) { return sum + 1; }, [](int) { return true; });
  EXPECT_EQ(run.count, 0U);
  EXPECT_EQ(run.sum, 7);
}

TEST(Partition, APartMayNoteWhatItIsFoundToTake) {
  struct Work {
    Some costs;
    std::uint64_t sum = 0;
  };
  const Costs costs{1, 2, 3, 4, 5, 6};
  const auto parts = parts_that_fit(
      Work{costs}, [](Work& work) { return (work.sum = sum_of(work.costs)) <= 9; },
      [](const Work& work) {
        const auto [first, rest] = halves(work.costs);
        return std::pair(Work{first}, Work{rest});
      });
  for (const Work& work : parts) EXPECT_EQ(work.sum, sum_of(work.costs));
}

TEST(Partition, CellsAreCutAcrossTheirLongerSide) {
  std::mt19937 random(test::seed());
  std::uniform_int_distribution<std::int64_t> size(1, 90);
  for (int round = 0; round < 50; ++round) {
    const CellRectangle all{5, 7, size(random), size(random)};
    std::vector<int> cells(static_cast<std::size_t>(all.count()));
    for (const CellRectangle& part : parts_that_fit(
             all, [](const CellRectangle& c) { return c.count() <= 40; },
             [](const CellRectangle& c) { return halves(c); })) {
      EXPECT_GT(part.count(), 0U);
      EXPECT_LE(part.count(), 40U);
      for (std::size_t i = 0; i < part.count(); ++i) {
        const RasterGrid::Cell cell = part.cell(i);
        ++cells[static_cast<std::size_t>((cell.row - all.row) * all.columns + cell.column - all.column)];
      }
    }
    EXPECT_EQ(cells, std::vector<int>(cells.size(), 1));
  }
  const auto [west, east] = halves(CellRectangle{0, 0, 4, 4});
  EXPECT_EQ(west.columns, 2);
  EXPECT_EQ(east.column, 2);
  const auto [north, south] = halves(CellRectangle{0, 0, 3, 4}, [](std::int64_t n) { return n - 1; });
  EXPECT_EQ(north.rows, 3);
  EXPECT_EQ(south.row, 3);
}

TEST(Partition, PlacesAreSortedFromTheSouthClockwise) {
  const std::vector<Point2> places{{1, 0}, {0, 1}, {-1, 0}, {-1, -9}, {1, -9}, {0, 2}};
  std::vector<std::size_t> order{5, 4, 3, 2, 1, 0};
  sort_by_azimuth(
      {0, 0}, [&](std::size_t i) { return places[i]; }, order);
  EXPECT_EQ(order, (std::vector<std::size_t>{3, 2, 1, 5, 0, 4}));
}

}  // namespace
}  // namespace itin::viewshed
