// Every colour of a map has a row of its own in the legend.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/counted.hpp>
#include <viewshed/result_map.hpp>

#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

/// All that is clear is alike.
std::uint32_t number_of(const Rgba& c) {
  return c.alpha == 0
             ? 0
             : std::uint32_t{c.red} << 24 | std::uint32_t{c.green} << 16 | std::uint32_t{c.blue} << 8 | c.alpha;
}

std::set<std::uint32_t> numbers_of(const std::vector<Rgba>& colours) {
  std::set<std::uint32_t> numbers;
  for (const Rgba& c : colours) numbers.insert(number_of(c));
  return numbers;
}

constexpr double kLow = -20;  ///< an elevation that some of the ground is above

struct SurveyedMap {
  Result result;
  ResultMap map;

  /// Those of cells of a verdict.
  std::set<std::uint32_t> shown(Verdict verdict) const {
    std::set<std::uint32_t> numbers;
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      if (result.visible[i] == verdict) numbers.insert(number_of(map.cells[i]));
    return numbers;
  }
};

SurveyedMap surveyed_map(Mode mode, bool low_targets = false) {
  const Tin tin = test::fractal_tin(65, 50, 200, 0.5, 9);
  Request request;
  request.observers = {{"Mast", {301000, 201500}, 30}, {"Tower", {302000, 201000}, 30}};
  request.cell_size = 25;
  request.mode = mode;
  if (low_targets) request.target_absolute = true, request.target_height = kLow;
  NoProgress progress;
  SurveyedMap s{compute(tin, request, progress), {}};
  s.map = result_map(s.result, {});
  return s;
}

TEST(ResultMap, SeenAndHiddenHaveAllTheirColoursInTheLegend) {
  for (const Mode mode : {Mode::kVisible, Mode::kCount, Mode::kBlocker, Mode::kHeight}) {
    const SurveyedMap s = surveyed_map(mode);
    ASSERT_EQ(s.map.keys.size(), 2U);
    EXPECT_EQ(numbers_of(s.map.keys[0].colours), s.shown(Verdict::kVisible));
    EXPECT_EQ(numbers_of(s.map.keys[1].colours), s.shown(Verdict::kHidden));
  }
}

TEST(ResultMap, EveryStepOfAScaleHasAColourOfItsOwn) {
  for (const Mode mode : {Mode::kBlocker, Mode::kHeight}) {
    const SurveyedMap s = surveyed_map(mode);
    std::set<std::uint32_t> steps;
    for (const ResultMap::Key& key : s.map.scale) {
      ASSERT_EQ(key.colours.size(), 1U);
      EXPECT_TRUE(steps.insert(number_of(key.colours.front())).second);
    }
    std::set<std::uint32_t> shown = s.shown(Verdict::kVisible);
    shown.merge(s.shown(Verdict::kHidden));
    EXPECT_EQ(steps, shown);
  }
}

TEST(ResultMap, TargetsBelowTheGroundAreAClassOfBlockers) {
  const SurveyedMap s = surveyed_map(Mode::kBlocker, true);
  const std::set<std::uint32_t> hidden = s.shown(Verdict::kHidden);
  ASSERT_EQ(hidden.size(), 2U);  // terrain before it, and its own
  EXPECT_EQ(s.map.scale.back().text, "own ground");
  EXPECT_EQ(s.map.scale.back().colours.front().alpha, 0);
  EXPECT_EQ(numbers_of(s.map.keys[1].colours), hidden);
}

TEST(ResultMap, TargetsBelowTheGroundAreAClassOfHeights) {
  const SurveyedMap s = surveyed_map(Mode::kHeight, true);
  const std::set<std::uint32_t> seen = s.shown(Verdict::kVisible), hidden = s.shown(Verdict::kHidden);
  EXPECT_EQ(s.map.scale.back().text, "buried");
  const std::uint32_t buried = number_of(s.map.scale.back().colours.front());
  EXPECT_TRUE(hidden.contains(buried));
  EXPECT_FALSE(seen.contains(buried));
  // Targets above the ground are seen at other heights than 0, too.
  EXPECT_GT(seen.size(), 1U);
  EXPECT_EQ(numbers_of(s.map.keys[0].colours), seen);
  EXPECT_EQ(numbers_of(s.map.keys[1].colours), hidden);
}

/// Cells without a value, undecided ones among them, look as none of the others do, and the legend counts them.
TEST(ResultMap, CellsWithoutAValueAreAClassOfTheirOwn) {
  for (const Mode mode : {Mode::kHeight, Mode::kLoss, Mode::kLevel}) {
    SurveyedMap s = surveyed_map(Mode::kHeight);
    Result& result = s.result;
    std::vector<float> values = result.get<LeastHeights>().height_m;
    for (std::size_t i = 0; i < 400; ++i) values[i] = std::nanf("");
    for (std::size_t i = 0; i < 100; ++i) result.visible[i] = Verdict::kUndecided;
    result.cells = {};
    for (const Verdict verdict : result.visible) {
      std::uint64_t* const counts[] = {&result.cells.hidden, &result.cells.visible, &result.cells.undecided};
      if (const auto v = static_cast<std::size_t>(verdict); v < std::size(counts)) ++*counts[v];
    }
    result.request.mode = mode;
    result.request.budget.sensitivity_dbm = 30;
    if (mode == Mode::kHeight) result.values = LeastHeights{values};
    if (mode == Mode::kLoss) result.values = Losses{values, {}};
    if (mode == Mode::kLevel) result.values = Levels{values, {}, {}};
    const ResultMap map = result_map(result, {});
    const auto key = std::ranges::find_if(map.keys, [](const ResultMap::Key& k) {
      return k.text.starts_with("No ") && k.text.find(" known: ") != std::string::npos;
    });
    ASSERT_NE(key, map.keys.end());
    EXPECT_THAT(key->text, testing::HasSubstr(fmt::format("({:.1f} %)", 100.0 * 400 / result.cells.in_view())));
    std::set<std::uint32_t> without, others;
    for (std::size_t i = 0; i < map.cells.size(); ++i) (i < 400 ? without : others).insert(number_of(map.cells[i]));
    EXPECT_EQ(without, numbers_of(key->colours));
    for (const std::uint32_t colour : without) EXPECT_FALSE(others.contains(colour));
    for (const ResultMap::Key& k : map.keys) EXPECT_FALSE(k.text.starts_with("Undecided")) << k.text;
  }
}

TEST(ResultMap, SmallAreasAreInSquareMetres) {
  Request request;
  request.observers = {{"Mast", {301000, 201500}, 30}};
  request.cell_size = 25, request.radius = 100;
  NoProgress progress;
  const Result result = compute(test::fractal_tin(65, 50, 200, 0.5, 9), request, progress);
  const auto area = static_cast<std::uint64_t>(result.grid.cell_area()) * result.cells.visible;
  EXPECT_THAT(result_map(result, {}).keys.front().text, testing::StartsWith("Visible: " + grouped(area) + " m² ("));
}

}  // namespace
}  // namespace itin::viewshed
