// Reads numbers from text; strictly, and whatever the locale. `name` is what an error calls the value: an option, or
// "its height".
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace itin {

/// The numbers that are taken.
enum class NumberRange { kAny, kNotNegative, kPositive };

/// Reads a number that is the whole text; nothing where it is none, or is not finite. std::from_chars ignores the
/// locale, but accepts no leading plus sign, and accepts inf and nan.
template <typename Number>
std::optional<Number> whole_text_as(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

/// Reads a finite decimal number and nothing else. Throws InputError.
double parse_number(std::string_view name, std::string_view text, NumberRange range = NumberRange::kAny);

/// Reads metres up to kFarthestHeight. Throws InputError.
double parse_height(std::string_view name, std::string_view text, NumberRange range = NumberRange::kAny);

}  // namespace itin
