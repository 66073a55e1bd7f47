#include "huge_store/fractal.hpp"

#include <array>
#include <cmath>

namespace itin::huge {

namespace {

constexpr std::int32_t kLowest = 3000, kHighest = 12000;  // decimetres, of the top stage
constexpr double kRoughness = 0.85;

constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9;
  v = (v ^ (v >> 27)) * 0x94d049bb133111eb;
  return v ^ (v >> 31);
}

std::uint64_t hash(std::uint64_t row_key, std::int32_t column) {
  return mix(row_key + static_cast<std::uint64_t>(column) * kStep);
}

/// A number from 0 to count - 1, by the hash's upper half.
std::int32_t below(std::uint64_t hash, std::int32_t count) {
  return static_cast<std::int32_t>((hash >> 32) * static_cast<std::uint64_t>(count) >> 32);
}

}  // namespace

std::int32_t Fractal::amplitude(int stage) {
  return static_cast<std::int32_t>(std::lround(std::exp2(kRoughness * stage)));
}

double Fractal::greatest_deviation(int stage) {
  double sum = 0;
  for (int k = 0; k < stage; ++k) sum += amplitude(k) + 0.5;
  return sum;
}

std::uint64_t Fractal::row_key(int stage, std::int32_t row) const {
  return mix(mix(seed_ + static_cast<std::uint64_t>(stage) * kStep) + static_cast<std::uint64_t>(row) * kStep);
}

Posts Fractal::heights(int stage, const PostBox& box) const {
  if (stage == kTopStage) {
    Posts top(box);
    for (std::int32_t row = box.rows.first; row <= box.rows.last; ++row) {
      for (std::int32_t column = box.columns.first; column <= box.columns.last; ++column)
        *top.at(column, row) = kLowest + below(hash(row_key(stage, row), column), kHighest - kLowest + 1);
    }
    return top;
  }
  const std::int32_t most = amplitude(stage);
  return refined(
      heights(stage + 1, box.coarser(1)), box, [](std::int32_t z) { return z; },
      [&](std::int32_t a, std::int32_t b, std::int32_t column, std::int32_t row) {
        const std::uint64_t h = hash(row_key(stage, row), column);
        const auto rounding = static_cast<std::int32_t>(h & 1);
        return ((a + b + rounding) >> 1) + below(h, 2 * most + 1) - most;
      });
}

}  // namespace itin::huge
