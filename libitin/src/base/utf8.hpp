// Writes single characters in UTF-8.
#pragma once

#include <string>

namespace itin {

/// Appends a character of Unicode.
inline void append_utf8(char32_t character, std::string& text) {
  const auto first = [&](char32_t mark, unsigned shift) { text += static_cast<char>(mark | character >> shift); };
  const auto next = [&](unsigned shift) { text += static_cast<char>(0x80U | (character >> shift & 0x3FU)); };
  if (character < 0x80) {
    first(0, 0);
  } else if (character < 0x800) {
    first(0xC0, 6), next(0);
  } else if (character < 0x10000) {
    first(0xE0, 12), next(6), next(0);
  } else {
    first(0xF0, 18), next(12), next(6), next(0);
  }
}

}  // namespace itin
