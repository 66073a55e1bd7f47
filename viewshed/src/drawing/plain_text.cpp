#include "drawing/plain_text.hpp"

#include <algorithm>
#include <cstdint>

namespace itin::viewshed {

namespace {

/// U+00C0 to U+017F without accents, in order.
constexpr std::string_view kLatin =
    "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTs"
    "aaaaaaaceeeeiiiidnooooo/ouuuuyty"
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlL"
    "lLlNnNnNnnNnOoOoOoOoRrRrRrSsSsSsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";
static_assert(kLatin.size() == 0x180 - 0xC0);

std::string plain(std::uint32_t letter) {
  if (letter >= 0xC0 && letter < 0x180) return std::string(1, kLatin[letter - 0xC0]);
  switch (letter) {
    case 0xA0:
      return " ";
    case 0xA9:
      return "(c)";
    case 0xB0:
      return " deg";
    case 0xB1:
      return "+/-";
    case 0xD7:
      return "x";
    case 0x2013:
    case 0x2014:
    case 0x2212:
      return "-";
    case 0x2018:
    case 0x2019:
      return "'";
    case 0x201C:
    case 0x201D:
      return "\"";
    default:
      return "?";
  }
}

}  // namespace

std::string plain_text(std::string_view utf8) {
  std::string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<std::uint8_t>(utf8[i++]);
    if (first < 0x80) {
      text += static_cast<char>(first);
      continue;
    }
    std::uint32_t letter = first >= 0xF0 ? first & 0x07u : first >= 0xE0 ? first & 0x0Fu : first & 0x1Fu;
    while (i < utf8.size() && (static_cast<std::uint8_t>(utf8[i]) & 0xC0) == 0x80)
      letter = letter << 6 | (static_cast<std::uint8_t>(utf8[i++]) & 0x3Fu);
    text += plain(letter);
  }
  return text;
}

std::vector<PlainPiece> plain_pieces(std::string_view utf8) {
  constexpr std::string_view kSquared = "\u00B2";
  std::vector<PlainPiece> pieces;
  while (!utf8.empty()) {
    const std::size_t end = std::min(utf8.find(kSquared), utf8.size());
    if (end > 0) pieces.push_back({plain_text(utf8.substr(0, end)), false});
    utf8.remove_prefix(end);
    if (utf8.empty()) break;
    pieces.push_back({"2", true});
    utf8.remove_prefix(kSquared.size());
  }
  return pieces;
}

}  // namespace itin::viewshed
