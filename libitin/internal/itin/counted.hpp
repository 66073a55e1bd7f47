// Numbers and lists in the form people read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

/// Returns 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// Returns "1 block", "1,234 blocks"; `plural` is given where it is not formed with an s.
std::string counted(std::uint64_t number, std::string_view noun, std::string_view plural = {});

/// Returns a finite number with so many significant digits, and no zeros after them, but never with an exponent nor
/// with fewer digits than its whole part has: significant(0.01234, 2) is "0.012", significant(12345.6, 2) is "12346".
std::string significant(double number, int digits);

/// Returns "walls", "walls and woods", "buildings, walls and woods".
std::string listed(const std::vector<std::string>& words);

}  // namespace itin
