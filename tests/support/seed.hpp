// The seed of tests on random input.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>

namespace itin::test {

/// Returns $ITIN_TEST_SEED or, where that is not set, another seed in every process. The seed is printed, so that a
/// failure can be repeated.
inline std::uint32_t seed() {
  static const std::uint32_t seed = [] {
    const char* given = std::getenv("ITIN_TEST_SEED");
    const auto chosen = given ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10)) : std::random_device{}();
    std::cout << "ITIN_TEST_SEED=" << chosen << "\n";
    return chosen;
  }();
  return seed;
}

}  // namespace itin::test
