// The seed of tests on random input.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>

namespace itin::test {

/// $ITIN_TEST_SEED, or where it is not set another in every process. Printed, so that a failure can be repeated.
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
