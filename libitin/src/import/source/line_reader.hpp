// Reads a text file line by line, fast and in bounded memory.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

class LineReader {
 public:
  /// Longer lines are refused: the file is not text.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 16;

  /// Opens the file. Throws FileError.
  explicit LineReader(std::string path);

  /// The next line without its end (LF or CRLF) and without a leading byte order mark; nothing at the end of the file.
  /// The view holds until the next call. Throws FileError, InputError (a line too long).
  std::optional<std::string_view> next();
  /// The number of the line returned last, from 1.
  std::uint64_t line_number() const { return line_number_; }
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  bool refill();

  std::string path_;
  std::ifstream in_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< unread bytes of the buffer
  std::uint64_t line_number_ = 0;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace itin
