// Whole numbers of 128 bits, which GCC and Clang have on every 64-bit machine.
#pragma once

#include <bit>
#include <cstdint>

namespace itin {

__extension__ typedef __int128 Int128;

/// The nearest double, as static_cast gives it in three times the time.
inline double to_double(Int128 v) {
  if (v == static_cast<std::int64_t>(v)) return static_cast<double>(static_cast<std::int64_t>(v));
  __extension__ typedef unsigned __int128 Unsigned;
  const Unsigned magnitude = v < 0 ? -static_cast<Unsigned>(v) : static_cast<Unsigned>(v);
  // The first 63 bits are more than a double has: of those that follow it only matters whether any is set.
  const int shift = 65 - std::countl_zero(static_cast<std::uint64_t>(magnitude >> 64));
  const bool more = (magnitude & ((Unsigned{1} << shift) - 1)) != 0;
  const std::int64_t head = static_cast<std::int64_t>(magnitude >> shift) | (more ? 1 : 0);
  constexpr int kBias = 1023, kFractionBits = 52;
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(kBias + shift) << kFractionBits);
  return static_cast<double>(v < 0 ? -head : head) * scale;
}

}  // namespace itin
