#include <charconv>

#include <itin/decimal_comma.hpp>

namespace itin {

namespace {

std::optional<double> number_with_point(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

bool may_part_thousands(std::string_view number) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos) return false;
  if (number.find(',', comma + 1) != std::string_view::npos) return true;
  const std::size_t digits = number.find_first_not_of(kDigits, comma + 1);
  const std::size_t after = (digits == std::string_view::npos ? number.size() : digits) - comma - 1;
  const std::size_t first = number.find_first_of(kDigits);
  const bool groups = first < comma && comma - first <= 3 && number[first] != '0';
  return after == 3 && groups;
}

std::string with_decimal_point(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.find('.') != std::string::npos || may_part_thousands(text)) return text;
  text[comma] = '.';
  return text;
}

std::optional<double> number_in(std::string_view text) {
  const std::optional<double> number = number_with_point(text);
  if (number || text.find(',') == std::string_view::npos) return number;
  return number_with_point(with_decimal_point(std::string(text)));
}

}  // namespace itin
