#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/parsed_number.hpp>

namespace itin {

namespace {

[[noreturn]] void refuse_number(std::string_view name, std::string_view text, std::string_view expected) {
  throw InputError(fmt::format("{} '{}': {}", name, text, expected));
}

}  // namespace

double parse_number(std::string_view name, std::string_view text, NumberRange range) {
  const std::optional<double> value = whole_text_as<double>(text);
  if (!value) refuse_number(name, text, "not a number");
  if (range == NumberRange::kPositive && *value <= 0) refuse_number(name, text, "must be greater than 0");
  if (range == NumberRange::kNotNegative && *value < 0) refuse_number(name, text, "must not be negative");
  return *value;
}

double parse_height(std::string_view name, std::string_view text, NumberRange range) {
  const double height = parse_number(name, text, range == NumberRange::kNotNegative ? NumberRange::kAny : range);
  if (range == NumberRange::kNotNegative && height < 0)
    refuse_number(name, text, "a height must not be negative; 0 is the ground itself");
  require_height(height, fmt::format("{} '{}'", name, text));
  return height;
}

}  // namespace itin
