#include "store/codec/block_codec.hpp"

#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "libitin/store/random_points.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/store_writer.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::Scatter;

/// The block's points with their levels, whatever their order.
std::map<std::uint64_t, std::pair<std::int32_t, std::uint8_t>> by_code(const Block& block) {
  std::map<std::uint64_t, std::pair<std::int32_t, std::uint8_t>> points;
  for (std::size_t k = 0; k < block.points.size(); ++k)
    points[code_of(block.points[k])] = {block.points[k].z, block.levels.empty() ? std::uint8_t{0} : block.levels[k]};
  return points;
}

void expect_round_trip(const Cell& cell, const std::vector<GridPoint>& points,
                       const std::vector<std::uint16_t>& sources, const std::vector<std::uint8_t>& levels = {}) {
  const auto bytes = encode_block(cell, points, sources, levels);
  const Block block = decode_block(cell, bytes);
  EXPECT_EQ(block.points, points);
  EXPECT_EQ(test::each_of(block.sources), sources);
  EXPECT_EQ(block.levels, levels);
  EXPECT_EQ(by_code(decode_block(cell, bytes, BlockOrder::kAny)), by_code(block));
  Block plan = decode_plan(cell, bytes);
  std::sort(plan.points.begin(), plan.points.end(),
            [](const GridPoint& a, const GridPoint& b) { return code_of(a) < code_of(b); });
  ASSERT_EQ(plan.points.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_EQ(std::pair(plan.points[k].x, plan.points[k].y), std::pair(points[k].x, points[k].y));
  if (const auto posts = decode_posts(cell, bytes)) {
    ASSERT_EQ(std::size_t{posts->columns} * posts->rows, points.size());
    for (const GridPoint& p : points) {
      const std::int64_t column = (p.x - posts->lattice.x) / posts->lattice.step_x,
                         row = (p.y - posts->lattice.y) / posts->lattice.step_y;
      EXPECT_EQ(posts->heights[static_cast<std::size_t>(row * posts->columns + column)], p.z);
    }
  }
}

class BlockCodecScatter : public testing::TestWithParam<Scatter> {};

TEST_P(BlockCodecScatter, RoundTrip) {
  std::mt19937_64 random(test::seed());
  for (const int log2_side : {4, 5, 7, 10, 13, 17, 22, 29, 30}) {
    for (const std::size_t count : {1, 2, 3, 10, 255, 512, 2000}) {
      Cell cell{morton(-12345, 67890), log2_side};
      cell.code &= ~((std::uint64_t{1} << (2 * log2_side)) - 1);
      const auto points = test::scatter(GetParam(), cell, count, random);
      std::vector<std::uint16_t> sources;
      for (std::size_t i = 0; i < points.size(); ++i) sources.push_back(random() % 7 ? 3 : random() & 0xffff);
      SCOPED_TRACE(testing::Message() << "side 2^" << log2_side << ", " << points.size() << " points");
      expect_round_trip(cell, points, sources);
      std::vector<std::uint8_t> levels;
      for (std::size_t i = 0; i < points.size(); ++i)
        levels.push_back(static_cast<std::uint8_t>(random() % 20 == 0 ? 63 : random() % 5));
      levels[0] = 1;
      expect_round_trip(cell, points, sources, levels);
    }
  }
}

TEST(BlockCodec, FullLatticesRoundTrip) {
  std::mt19937_64 random(test::seed());
  for (const int step : {1, 3, 64, 700}) {
    for (const auto& [columns, rows] : {std::pair{1, 2}, std::pair{2, 1}, std::pair{13, 13}, std::pair{60, 17}}) {
      const Cell cell{morton(-65536, 65536), 16};
      std::vector<GridPoint> points;
      for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
          points.push_back({-65536 + 11 + step * column, 65536 + 5 + step * row,
                            static_cast<std::int32_t>(20 * (random() % 100)) - 30 * row});
      points = test::in_curve_order(points);
      std::vector<std::uint8_t> levels;
      for (std::size_t i = 0; i < points.size(); ++i) levels.push_back(static_cast<std::uint8_t>(1 + random() % 7));
      const std::vector<std::uint16_t> sources(points.size(), 3);
      expect_round_trip(cell, points, sources);
      expect_round_trip(cell, points, sources, levels);
      ASSERT_TRUE(decode_posts(cell, encode_block(cell, points, sources, levels)).has_value());
      // One post less, within, and it is no full lattice.
      if (columns < 3 || rows < 3) continue;
      const auto inner = std::find_if(points.begin(), points.end(), [&](const GridPoint& p) {
        return p.x == -65536 + 11 + step && p.y == 65536 + 5 + step;
      });
      points.erase(inner);
      EXPECT_FALSE(decode_posts(cell, encode_block(cell, points, std::vector<std::uint16_t>(points.size(), 3))));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BlockCodecScatter,
                         testing::Values(Scatter::Uniform, Scatter::Clustered, Scatter::Lattice, Scatter::SparseLattice,
                                         Scatter::Line, Scatter::FlatLattice));

TEST(BlockCodec, ExtremeHeightsAndCorners) {
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  constexpr auto least = std::numeric_limits<std::int32_t>::min(), most = std::numeric_limits<std::int32_t>::max();
  const auto points = test::in_curve_order(
      {{low, low, least}, {high, low, most}, {low, high, most}, {high, high, least}, {0, 0, 0}, {-1, -1, most}});
  expect_round_trip(Cell{}, points, {0, 1, 65535, 65535, 0, 0});
  expect_round_trip(Cell{}, {{low, low, least}, {low, high, most}}, {1, 1});
  expect_round_trip(Cell{}, {{high, high, most}}, {9});
}

TEST(BlockCodec, FullLatticeOfFullCapacity) {
  std::vector<GridPoint> points;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) points.push_back({x, y, x * y});
  }
  expect_round_trip(Cell{morton(0, 0), 6}, test::in_curve_order(points),
                    std::vector<std::uint16_t>(kMaxBlockPoints, 2));
}

// The round trip alone would not notice that a pattern is no longer found.
TEST(BlockCodec, CommonStepsAndSmoothHeightsVanish) {
  std::vector<GridPoint> points;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) points.push_back({2500 + 5000 * x, 700 + 5000 * y, 10 * (x + 2 * y)});
  }
  const auto bytes =
      encode_block(Cell{morton(0, 0), 17}, test::in_curve_order(points), std::vector<std::uint16_t>(400));
  EXPECT_LT(bytes.size(), 250u);  // five bits per point: one for the position, the rest for the height
}

TEST(BlockCodec, TheHeaderTellsALatticeOfAllPoints) {
  std::mt19937_64 random(test::seed());
  for (const Scatter how : {Scatter::Uniform, Scatter::Lattice, Scatter::SparseLattice, Scatter::Clustered}) {
    for (const Cell cell : {Cell{morton(0, 0), 16}, Cell{morton(-65536, 131072), 15}}) {
      const auto points = test::scatter(how, cell, 200, random);
      const auto bytes = encode_block(cell, points, std::vector<std::uint16_t>(points.size(), 1));
      const auto [count, lattice] = decode_lattice(cell, bytes);
      EXPECT_EQ(count, points.size());
      for (const GridPoint& p : points) {
        EXPECT_EQ((std::int64_t{p.x} - lattice.x) % lattice.step_x, 0);
        EXPECT_EQ((std::int64_t{p.y} - lattice.y) % lattice.step_y, 0);
      }
      if (how == Scatter::Lattice) {
        EXPECT_GT(lattice.step_x, 1);
      }
    }
  }
}

RC_GTEST_PROP(BlockCodec, AnyPointsRoundTrip, ()) {
  const Cell cell{morton(0, 0), 12};
  std::vector<GridPoint> points = {{0, 0, 0}};
  for (int i = *rc::gen::inRange(0, 300); i > 0; --i) {
    points.push_back({*rc::gen::inRange(0, 4096), *rc::gen::inRange(0, 4096), *rc::gen::arbitrary<std::int32_t>()});
  }
  points = test::in_curve_order(std::move(points));
  const std::vector<std::uint16_t> sources(points.size(), *rc::gen::arbitrary<std::uint16_t>());
  const Block block = decode_block(cell, encode_block(cell, points, sources));
  RC_ASSERT(block.points == points);
  RC_ASSERT(test::each_of(block.sources) == sources);
}

TEST(PointSources, OfOneSourceTakeNoMemory) {
  PointSources sources;
  std::vector<std::uint16_t> expected;
  for (const auto& [source, points] : {std::pair{std::uint16_t{7}, 1000u}, {std::uint16_t{7}, 1u}}) {
    sources.add(source, points);
    expected.insert(expected.end(), points, source);
  }
  EXPECT_EQ(test::each_of(sources), expected);
  EXPECT_EQ(sources.bytes(), 0U);
  for (const std::uint16_t source : {8, 8, 7}) sources.add(source), expected.push_back(source);
  EXPECT_EQ(test::each_of(sources), expected);
}

// Whatever the bytes: an error, or a block that keeps its promises.
void expect_error_or_valid(const Cell& cell, const std::vector<std::uint8_t>& bytes) {
  try {
    const PostLattice lattice = decode_lattice(cell, bytes).lattice;
    ASSERT_TRUE(lattice.step_x >= 1 && lattice.step_y >= 1 &&
                cell.box().contains(static_cast<std::int32_t>(lattice.x), static_cast<std::int32_t>(lattice.y)));
  } catch (const DecodeError&) {
  }
  try {
    const Block block = decode_block(cell, bytes);
    ASSERT_FALSE(block.points.empty());
    ASSERT_EQ(block.sources.size(), block.points.size());
    ASSERT_TRUE(block.levels.empty() || block.levels.size() == block.points.size());
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      const std::uint64_t code = morton(block.points[i].x, block.points[i].y);
      ASSERT_TRUE(cell.box().contains(block.points[i].x, block.points[i].y));
      if (i > 0) {
        ASSERT_LT(morton(block.points[i - 1].x, block.points[i - 1].y), code);
      }
    }
  } catch (const DecodeError&) {
  }
}

TEST(BlockCodec, DamagedBytesNeverBreakThePromises) {
  std::mt19937_64 random(test::seed());
  for (const Scatter how : {Scatter::Uniform, Scatter::Lattice, Scatter::SparseLattice, Scatter::Clustered}) {
    const Cell cell{morton(0, 0), 16};
    const auto points = test::scatter(how, cell, 200, random);
    std::vector<std::uint8_t> levels(points.size(), 2);
    const auto sound = encode_block(cell, points, std::vector<std::uint16_t>(points.size(), 1), levels);
    for (int i = 0; i < 5000; ++i) {
      auto bytes = sound;
      const std::size_t reach = i % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 24);
      for (std::size_t n = 1 + random() % 3; n > 0; --n) bytes[random() % reach] = static_cast<std::uint8_t>(random());
      if (i % 5 == 0) bytes.resize(random() % bytes.size());
      expect_error_or_valid(cell, bytes);
    }
  }
}

TEST(BlockCodec, DamagedFullLatticesNeverBreakThePromises) {
  std::mt19937_64 random(test::seed());
  const Cell cell{morton(0, 0), 16};
  std::vector<GridPoint> points;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      points.push_back({100 + 3000 * x, 70 + 3000 * y, static_cast<std::int32_t>(random() % 500)});
  points = test::in_curve_order(points);
  const auto sound = encode_block(cell, points, std::vector<std::uint16_t>(400, 1), std::vector<std::uint8_t>(400, 1));
  for (int i = 0; i < 20000; ++i) {
    auto bytes = sound;
    const std::size_t reach = i % 2 ? bytes.size() : std::size_t{24};
    for (std::size_t n = 1 + random() % 3; n > 0; --n) bytes[random() % reach] = static_cast<std::uint8_t>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    expect_error_or_valid(cell, bytes);
    try {
      decode_posts(cell, bytes);
    } catch (const DecodeError&) {
    }
  }
}

TEST(BlockCodec, RandomBytesNeverBreakThePromises) {
  std::mt19937_64 random(test::seed());
  for (int i = 0; i < 50000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 80);
    // Small bytes make headers that get further.
    for (auto& b : bytes) b = static_cast<std::uint8_t>(random() % 2 ? random() : random() % 8);
    expect_error_or_valid(Cell{morton(0, 0), 4 + static_cast<int>(random() % 26)}, bytes);
  }
}

TEST(BlockCodec, TruncationAndTrailingBytesAreErrors) {
  std::mt19937_64 random(7);
  const Cell cell{morton(0, 0), 16};
  const auto points = test::scatter(Scatter::Uniform, cell, 100, random);
  auto bytes = encode_block(cell, points, std::vector<std::uint16_t>(points.size(), 1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(decode_block(cell, std::span(bytes).first(size)), DecodeError) << size;
  }
  bytes.push_back(0);
  EXPECT_THROW(decode_block(cell, bytes), DecodeError);
}

}  // namespace
}  // namespace itin
