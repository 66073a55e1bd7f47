#include "import/source/places/square_references.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string>

#include <fmt/format.h>

namespace itin {

namespace {

constexpr double kSide = 100000;            ///< the side of a square of two letters, metres
constexpr double kRowsRepeat = 20 * kSide;  ///< the letters of rows come again

/// Bands of latitude, eight degrees each from 80 degrees south, and metres of UTM below which none of them has ground.
constexpr std::string_view kBands = "CDEFGHJKLMNPQRSTUVWX";
constexpr std::array<double, 20> kLeastNorthing{1.1e6, 2.0e6, 2.8e6, 3.7e6, 4.6e6, 5.5e6, 6.4e6, 7.3e6, 8.2e6, 9.1e6,
                                                0,     0.8e6, 1.7e6, 2.6e6, 3.5e6, 4.4e6, 5.3e6, 6.2e6, 7.0e6, 7.9e6};

/// The text in capitals, without blanks.
std::string compact(std::string_view text) {
  std::string result;
  for (const unsigned char c : text)
    if (c != ' ') result += static_cast<char>(std::toupper(c));
  return result;
}

bool all_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Metres from digits of which the first are tens of kilometres.
double metres_of(std::string_view digits) {
  double metres = 0, unit = kSide;
  for (const char c : digits) metres += (c - '0') * (unit /= 10);
  return metres;
}

std::optional<double> easting_of(char letter, int zone) {
  constexpr std::array<std::string_view, 3> kColumns{"STUVWXYZ", "ABCDEFGH", "JKLMNPQR"};
  const std::size_t column = kColumns[static_cast<std::size_t>(zone % 3)].find(letter);
  if (column == std::string_view::npos) return std::nullopt;
  return (static_cast<double>(column) + 1) * kSide;
}

std::optional<double> northing_of(char letter, int zone, double least) {
  constexpr std::string_view kRows = "ABCDEFGHJKLMNPQRSTUV";
  const std::size_t row = kRows.find(letter);
  if (row == std::string_view::npos) return std::nullopt;
  double northing = static_cast<double>((row + (zone % 2 == 0 ? 15 : 0)) % kRows.size()) * kSide;
  while (northing < least) northing += kRowsRepeat;
  return northing;
}

}  // namespace

std::optional<WrittenPosition> military_grid(std::string_view text) {
  const std::string reference = compact(text);
  int zone = 0;
  const auto [end, error] = std::from_chars(reference.data(), reference.data() + reference.size(), zone);
  const std::string_view letters = std::string_view(reference).substr(static_cast<std::size_t>(end - reference.data()));
  if (error != std::errc() || zone < 1 || zone > 60 || letters.size() < 5) return std::nullopt;
  const std::string_view digits = letters.substr(3);
  const std::size_t band = kBands.find(letters[0]), half = digits.size() / 2;
  if (band == std::string_view::npos || digits.size() % 2 != 0 || half > 5 || !all_digits(digits)) return std::nullopt;
  const auto east = easting_of(letters[1], zone), north = northing_of(letters[2], zone, kLeastNorthing[band]);
  if (!east || !north) return std::nullopt;
  return WrittenPosition{{*east + metres_of(digits.substr(0, half)), *north + metres_of(digits.substr(half))},
                         fmt::format("EPSG:{}", (letters[0] >= 'N' ? 32600 : 32700) + zone)};
}

std::optional<WrittenPosition> maidenhead(std::string_view text) {
  const std::string locator = compact(text);
  if (locator.size() != 6 && locator.size() != 8 && locator.size() != 10) return std::nullopt;
  double width = 360, height = 180;
  Point2 corner{-180, -90};
  for (std::size_t i = 0; i < locator.size(); i += 2) {
    const bool digits = i % 4 == 2;
    const int parts = digits ? 10 : i == 0 ? 18 : 24;
    const int east = locator[i] - (digits ? '0' : 'A'), north = locator[i + 1] - (digits ? '0' : 'A');
    if (east < 0 || east >= parts || north < 0 || north >= parts) return std::nullopt;
    width /= parts, height /= parts;
    corner = {corner.x + east * width, corner.y + north * height};
  }
  return WrittenPosition{{corner.x + width / 2, corner.y + height / 2}, "EPSG:4326"};
}

}  // namespace itin
