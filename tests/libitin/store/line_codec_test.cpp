#include "store/segments/line_codec.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "libitin/store/random_points.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

constexpr Cell kCell{morton(-4096, 8192), 12};

/// Many share ends; lattice steps, levels and directions differ.
std::vector<Segment> random_lines(std::mt19937& random, std::size_t count, int step, bool forwards) {
  std::vector<Segment> segments;
  const auto in = [&](int low, int high) {
    return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low + 1));
  };
  while (segments.size() < count) {
    Segment s;
    s.theme = 7;
    s.ax = -4096 + step * in(-20, 400 / step), s.ay = 8192 + step * in(-20, 400 / step);
    s.bx = s.ax + step * in(forwards ? 1 : -9, 9), s.by = s.ay + step * in(-9, 9);
    if (segments.size() > 3 && in(0, 1) == 1) s.ax = segments.back().ax, s.ay = segments.back().ay;
    if (forwards && s.bx <= s.ax) continue;
    s.finest = static_cast<std::uint8_t>(in(0, 5));
    s.coarsest = static_cast<std::uint8_t>(in(0, 1) == 1 ? 0xff : s.finest + in(0, 3));
    s.reach = s.finest == 0 ? 0 : in(0, 5000);
    if (crosses(s, kCell) && (s.ax != s.bx || s.ay != s.by)) segments.push_back(s);
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

TEST(LineCodec, GivesBackWhatItWasGiven) {
  std::mt19937 random(test::seed());
  for (const std::size_t count : {1u, 2u, 40u, 256u}) {
    for (const int step : {1, 5, 50}) {
      for (const bool forwards : {false, true}) {
        const std::vector<Segment> segments = random_lines(random, count, step, forwards);
        const std::vector<std::uint8_t> bytes = encode_lines(kCell, segments);
        EXPECT_EQ(decode_lines(kCell, 7, segments.size(), bytes), segments);
        EXPECT_THROW(decode_lines(kCell, 7, segments.size() + 1, bytes), DecodeError);
        EXPECT_THROW(decode_lines(kCell, 7, segments.size() - 1, bytes), DecodeError);
      }
    }
  }
}

TEST(LineCodec, TakesTheGridsCorners) {
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const std::vector<Segment> diagonal{{low, high, high, low, 7, 3, 0xff, 2 * kGridHalfSide - 1}};
  EXPECT_EQ(decode_lines(Cell{}, 7, 1, encode_lines(Cell{}, diagonal)), diagonal);
}

TEST(LineCodec, NeverTrustsItsBytes) {
  std::mt19937 random(test::seed());
  const std::vector<Segment> segments = random_lines(random, 60, 1, false);
  const std::vector<std::uint8_t> bytes = encode_lines(kCell, segments);
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
    if (i % 4 == 0) damaged.resize(random() % damaged.size());
    try {
      for (const Segment& s : decode_lines(kCell, 7, segments.size(), damaged)) EXPECT_TRUE(crosses(s, kCell));
    } catch (const DecodeError&) {
    }
  }
}

}  // namespace
}  // namespace itin
