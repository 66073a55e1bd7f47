#include "base/decoded_text.hpp"

#include <algorithm>

#include <itin/error.hpp>

#include "base/utf8.hpp"

namespace itin {

namespace {

constexpr char32_t kReplacement = 0xFFFD;

bool is_first_surrogate(char32_t unit) {
  return unit >= 0xD800 && unit < 0xDC00;
}

bool is_second_surrogate(char32_t unit) {
  return unit >= 0xDC00 && unit < 0xE000;
}

}  // namespace

DecodedText::DecodedText(std::istream& file, std::string name)
    : file_(file), name_(std::move(name)), encoding_(encoding_of_start()) {}

/// Tells the encoding by a byte order mark, which is passed over, or by a zero in the first two bytes.
DecodedText::Encoding DecodedText::encoding_of_start() {
  char start[3];
  ahead_.assign(start, read_bytes(start, sizeof start));
  const auto begins_with = [&](std::string_view mark) {
    if (!ahead_.starts_with(mark)) return false;
    ahead_.erase(0, mark.size());
    return true;
  };
  if (begins_with("\xEF\xBB\xBF")) return Encoding::kBytes;
  if (begins_with("\xFF\xFE")) return Encoding::kLittleEndian;
  if (begins_with("\xFE\xFF")) return Encoding::kBigEndian;
  if (ahead_.size() < 2 || (ahead_[0] == '\0') == (ahead_[1] == '\0')) return Encoding::kBytes;
  return ahead_[0] == '\0' ? Encoding::kBigEndian : Encoding::kLittleEndian;
}

std::size_t DecodedText::read_bytes(char* to, std::size_t most) {
  const std::size_t before = std::min(most, ahead_.size());
  std::copy_n(ahead_.begin(), before, to);
  ahead_.erase(0, before);
  if (before == most || file_.eof()) return before;
  file_.read(to + before, static_cast<std::streamsize>(most - before));
  if (file_.bad() || (file_.fail() && !file_.eof())) throw FileError(name_, "cannot be read");
  bytes_read_ += static_cast<std::uint64_t>(file_.gcount());
  return before + static_cast<std::size_t>(file_.gcount());
}

std::optional<char32_t> DecodedText::next_unit() {
  char pair[2];
  if (read_bytes(pair, 2) < 2) return std::nullopt;
  const bool little = encoding_ == Encoding::kLittleEndian;
  const auto low = static_cast<unsigned char>(pair[little ? 0 : 1]), high = static_cast<unsigned char>(pair[little]);
  return static_cast<char32_t>(high << 8U | low);
}

std::optional<char32_t> DecodedText::next_character() {
  const std::optional<char32_t> unit = next_unit();
  if (!unit || is_second_surrogate(*unit)) return unit ? std::optional(kReplacement) : std::nullopt;
  if (!is_first_surrogate(*unit)) return unit;
  const std::optional<char32_t> second = next_unit();
  if (!second || !is_second_surrogate(*second)) return kReplacement;
  return 0x10000 + ((*unit - 0xD800) << 10U) + (*second - 0xDC00);
}

std::size_t DecodedText::read(char* to, std::size_t most) {
  if (encoding_ == Encoding::kBytes) return read_bytes(to, most);
  constexpr std::size_t kLongest = 4;
  std::string text;
  while (text.size() + kLongest <= most) {
    const std::optional<char32_t> character = next_character();
    if (!character) break;
    append_utf8(*character, text);
  }
  std::copy(text.begin(), text.end(), to);
  return text.size();
}

}  // namespace itin
