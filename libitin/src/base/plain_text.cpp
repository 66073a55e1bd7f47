#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/plain_text.hpp>

#include "base/utf8.hpp"

namespace itin {

namespace {

/// The characters of Windows-1252 from 0x80 to 0x9F; 0 where there is none. All others are those of Latin-1.
constexpr std::array<char32_t, 32> kOfWindows{0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                              0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                              0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                              0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

unsigned byte_of(char c) {
  return static_cast<unsigned char>(c);
}

bool is_control(char c) {
  return byte_of(c) < 0x20 || byte_of(c) == 0x7F;
}

bool parts_lines(char c) {
  return c == '\t' || c == '\n' || c == '\r';
}

std::size_t length_by_first_byte(unsigned byte) {
  return byte < 0x80 ? 1 : byte >= 0xC2 && byte < 0xE0 ? 2 : byte >= 0xE0 && byte < 0xF0 ? 3 : byte >= 0xF0 ? 4 : 0;
}

/// Returns the length of the character that the text begins with; 0 where it is none of UTF-8.
std::size_t character_length(std::string_view text) {
  const std::size_t length = length_by_first_byte(byte_of(text[0]));
  if (length <= 1) return length;
  if (length > text.size()) return 0;
  char32_t c = byte_of(text[0]) & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_of(text[i]) & 0xC0U) != 0x80) return 0;
    c = c << 6U | (byte_of(text[i]) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};  // shorter forms exist for what is below
  const bool surrogate = c >= 0xD800 && c < 0xE000;
  const bool not_in_xml = c == 0xFFFE || c == 0xFFFF;
  return c < kLeast[length] || c > 0x10FFFF || surrogate || not_in_xml ? 0 : length;
}

std::string from_windows(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const unsigned byte = byte_of(c);
    const char32_t character = byte >= 0x80 && byte < 0xA0 ? kOfWindows[byte - 0x80] : byte;
    append_utf8(character == 0 ? U'?' : character, text);
  }
  return text;
}

/// Tells whether a text has a control character that is no mere blank.
bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return is_control(c) && !parts_lines(c); });
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

bool is_plain_text(std::string_view text) {
  const auto is_plain = [](char c) { return byte_of(c) < 0x80 && !is_control(c); };
  if (std::all_of(text.begin(), text.end(), is_plain)) return true;
  return std::none_of(text.begin(), text.end(), is_control) && is_utf8(text);
}

std::string printable_text(std::string_view text) {
  std::string printable = is_utf8(text) ? std::string(text) : from_windows(text);
  std::replace_if(
      printable.begin(), printable.end(), [](char c) { return is_control(c) && !parts_lines(c); }, '?');
  return printable;
}

std::string plain_text(std::string_view text) {
  std::string plain = printable_text(text);
  std::replace_if(plain.begin(), plain.end(), parts_lines, ' ');
  return plain;
}

void PlainTexts::Finding::add(std::string_view place) {
  if (first.empty()) {
    first = place;
  } else {
    ++more;
  }
}

std::string without_outer_blanks(const std::string& text) {
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string PlainTexts::plain(std::string_view text, std::string_view place) {
  if (is_plain_text(text)) return std::string(text);
  if (!is_utf8(text)) not_utf8_.add(place);
  if (has_control(text)) control_.add(place);
  return plain_text(text);
}

std::string PlainTexts::described(const Finding& finding, const char* what) const {
  const std::string others = finding.more == 0 ? "" : fmt::format(" and {}", counted(finding.more, "other text"));
  return fmt::format("{}: {}{}: {}", path_, finding.first, others, what);
}

std::vector<std::string> PlainTexts::warnings() const {
  std::vector<std::string> lines;
  if (!not_utf8_.first.empty())
    lines.push_back(described(not_utf8_, "not written in UTF-8; read as Windows-1252, so check letters with accents"));
  if (!control_.first.empty()) lines.push_back(described(control_, "control characters are shown as question marks"));
  return lines;
}

}  // namespace itin
