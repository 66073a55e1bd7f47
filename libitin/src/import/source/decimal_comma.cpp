#include <itin/decimal_comma.hpp>

namespace itin {

bool may_part_thousands(std::string_view number) {
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos) return false;
  const std::size_t digits = number.find_first_not_of("0123456789", comma + 1);
  const std::size_t after = (digits == std::string_view::npos ? number.size() : digits) - comma - 1;
  return number.find(',', comma + 1) != std::string_view::npos || after == 3;
}

std::string with_decimal_point(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.find('.') != std::string::npos || may_part_thousands(text)) return text;
  text[comma] = '.';
  return text;
}

}  // namespace itin
