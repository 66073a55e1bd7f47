// Reads a text file line by line, fast and in bounded memory.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/decoded_text.hpp"

namespace itin {

class LineReader {
 public:
  /// Longer lines are refused: the file is not text.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 16;

  /// `file` must outlive it; `name` is for messages. Throws FileError.
  LineReader(std::istream& file, std::string name);

  /// The next line, in the encoding of DecodedText, without its end: LF, CRLF, or CR in a file that has no LF near its
  /// beginning. Nothing at the end of the file. The view holds until the next call. Throws FileError, InputError (a
  /// line too long).
  std::optional<std::string_view> next();
  /// The number of the line returned last, from 1.
  std::uint64_t line_number() const { return line_number_; }
  std::uint64_t bytes_read() const { return text_.bytes_read(); }

 private:
  bool refill();

  std::string name_;
  DecodedText text_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< unread bytes of the buffer
  char line_end_ = '\n';
  std::uint64_t line_number_ = 0;
};

}  // namespace itin
