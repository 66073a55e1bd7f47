// The fast way from 128 bits to a double against the compiler's.
#include <random>

#include <gtest/gtest.h>

#include <itin/int128.hpp>

#include "support/seed.hpp"

namespace itin {

namespace {

TEST(Int128, BecomesTheNearestDouble) {
  std::mt19937_64 random(test::seed());
  for (int round = 0; round < 200'000; ++round) {
    // Of every length, also such as lie in the middle between two doubles or next to it.
    const int length = round % 127;
    const std::uint64_t head = random() | (std::uint64_t{1} << 63), tail = random();
    Int128 v = static_cast<Int128>(head >> 1) << 64 | tail;
    if (round % 3 == 1) v = static_cast<Int128>((head >> 11 << 1 | 1) << 9) << 64 | (round & 1);
    v >>= 126 - length;
    EXPECT_EQ(to_double(v), static_cast<double>(v)) << round;
    EXPECT_EQ(to_double(-v), static_cast<double>(-v)) << round;
  }
  const Int128 least = static_cast<Int128>(1) << 126;
  EXPECT_EQ(to_double(-least - least), -0x1p127);
  EXPECT_EQ(to_double(0), 0);
}

}  // namespace

}  // namespace itin
