#include "import/footprints/written_height.hpp"

#include <algorithm>
#include <regex>

#include <cpl_conv.h>

namespace itin {

namespace {

constexpr double kFoot = 0.3048, kInchesInFoot = 12;

double decimal_in(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  return CPLAtof(text.c_str());
}

}  // namespace

std::optional<double> written_height(const std::string& text) {
  static const std::regex kMetres(R"(\s*(\d+(?:[.,]\d+)?)\s*(?:m|metres?|meters?)\s*)", std::regex::icase);
  static const std::regex kFeet(R"(\s*(\d+(?:[.,]\d+)?)\s*(?:ft|feet|foot)\s*)", std::regex::icase);
  static const std::regex kFeetAndInches(R"(\s*(\d+(?:\.\d+)?)\s*'\s*(?:(\d+(?:\.\d+)?)\s*(?:"|'')?)?\s*)");
  std::smatch parts;
  if (std::regex_match(text, parts, kMetres)) return decimal_in(parts[1]);
  if (std::regex_match(text, parts, kFeet)) return decimal_in(parts[1]) * kFoot;
  if (!std::regex_match(text, parts, kFeetAndInches)) return std::nullopt;
  const double inches = parts[2].matched ? decimal_in(parts[2]) : 0;
  return (decimal_in(parts[1]) + inches / kInchesInFoot) * kFoot;
}

}  // namespace itin
