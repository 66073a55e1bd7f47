#include "modes/lines/error_realisations.hpp"

#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <numbers>
#include <random>
#include <utility>

namespace itin::viewshed {

namespace {

std::array<float, ErrorRealisations::kCount> equally_probable() {
  std::array<float, ErrorRealisations::kCount> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
    values[i] = static_cast<float>(std::numbers::sqrt2 * boost::math::erf_inv(2 * middle - 1));
  }
  return values;
}

/// The finalizer of SplitMix (Steele, Lea and Flood 2014).
std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15;
  number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9;
  number = (number ^ number >> 27) * 0x94d049bb133111eb;
  return number ^ number >> 31;
}

}  // namespace

ErrorRealisations::ErrorRealisations() {
  std::array<float, kCount> values = equally_probable();
  std::mt19937_64 random(1979);
  rows_.reserve(kRows * 2 * kCount);
  for (std::size_t row = 0; row < kRows; ++row) {
    // std::shuffle is not used, because it differs between libraries.
    for (std::size_t i = kCount; i-- > 1;) std::swap(values[i], values[random() % (i + 1)]);
    for (int twice = 0; twice < 2; ++twice) rows_.insert(rows_.end(), values.begin(), values.end());
  }
}

std::span<const float, ErrorRealisations::kCount> ErrorRealisations::of(std::uint64_t number) const {
  const std::uint64_t h = scrambled(number);
  const std::size_t row = h % kRows, begin = h / kRows % kCount;
  return std::span<const float, kCount>(rows_.data() + row * 2 * kCount + begin, kCount);
}

}  // namespace itin::viewshed
