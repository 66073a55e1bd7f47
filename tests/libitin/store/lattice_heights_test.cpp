#include "store/codec/lattice_heights.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin {
namespace {

std::vector<std::int64_t> round_trip(const std::vector<std::int64_t>& heights, std::size_t columns) {
  std::vector<std::uint8_t> bytes;
  put_lattice_heights(bytes, heights, columns);
  ByteReader in(bytes);
  std::vector<std::int64_t> read(heights.size());
  read_lattice_heights(in, read, columns);
  EXPECT_TRUE(in.rest().empty());
  return read;
}

TEST(LatticeHeights, OfEveryWidthAndShapeRoundTrip) {
  std::mt19937_64 random(test::seed());
  for (int bits = 0; bits <= 32; ++bits) {
    for (const std::size_t columns : {1, 2, 7, 8, 9, 64}) {
      for (const std::size_t rows : {1, 3, 8, 31}) {
        std::vector<std::int64_t> heights(columns * rows);
        const std::int64_t most = std::int64_t{1} << bits;
        for (std::int64_t& h : heights) h = std::uniform_int_distribution<std::int64_t>(-most, most)(random);
        // Calm rows beside rough ones have groups of different widths.
        for (std::size_t i = 0; i < heights.size(); ++i)
          if (i / columns % 3 == 1) heights[i] = 5;
        heights[0] = 0;
        ASSERT_EQ(round_trip(heights, columns), heights) << bits << " bits, " << columns << " x " << rows;
      }
    }
  }
}

TEST(LatticeHeights, OfAPlaneTakeLittleMoreThanHalfABitEach) {
  std::vector<std::int64_t> heights;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) heights.push_back(3 * column - 2 * row);
  std::vector<std::uint8_t> bytes;
  put_lattice_heights(bytes, heights, 64);
  EXPECT_LT(bytes.size(), 64U * 64 / 16 + 64 * 3);  // the widths alone, and the first row and column
}

// Whatever the bytes: an error, or heights that leave no number's range.
TEST(LatticeHeights, OfDamagedBytesAreBounded) {
  std::mt19937_64 random(test::seed());
  std::vector<std::int64_t> heights(20 * 20);
  for (std::size_t i = 1; i < heights.size(); ++i) heights[i] = static_cast<std::int64_t>(random() % 2000);
  std::vector<std::uint8_t> sound;
  put_lattice_heights(sound, heights, 20);
  int errors = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::uint8_t> bytes = sound;
    const std::size_t reach = i % 2 != 0 ? bytes.size() : 27;
    for (std::size_t n = 1 + random() % 3; n > 0; --n) bytes[random() % reach] = static_cast<std::uint8_t>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    std::vector<std::int64_t> read(heights.size());
    try {
      ByteReader in(bytes);
      read_lattice_heights(in, read, 20);
    } catch (const DecodeError&) {
      ++errors;
      continue;
    }
    for (const std::int64_t h : read) ASSERT_LT(std::abs(h), std::int64_t{1} << 60);
  }
  EXPECT_GT(errors, 1000);
}

TEST(LatticeHeights, BytesThatNobodyWritesAreErrors) {
  const auto read = [](std::vector<std::uint8_t> bytes, std::size_t count) {
    ByteReader in(bytes);
    std::vector<std::int64_t> heights(count);
    read_lattice_heights(in, heights, count);
  };
  EXPECT_NO_THROW(read({1, 0x01, 0b110}, 3));
  EXPECT_THROW(read({0, 0x01, 0b110}, 3), DecodeError);     // no width
  EXPECT_THROW(read({23, 0x01, 0b110}, 3), DecodeError);    // wider than any height
  EXPECT_THROW(read({1, 0x11, 0b110, 0}, 3), DecodeError);  // a width beyond the last group
  EXPECT_THROW(read({1, 0x01, 0b1110}, 3), DecodeError);    // a height beyond the last one
  EXPECT_THROW(read({1, 0x01, 0b111}, 3), DecodeError);     // the first height is not the first
  EXPECT_THROW(read({1, 0x01}, 3), DecodeError);            // too few bytes
}

}  // namespace
}  // namespace itin
