// The bytes of a text file in UTF-8, whichever encoding its first bytes show: UTF-8 with a byte order mark or without,
// or UTF-16 of either byte order. Bytes that are not UTF-8 are handed on as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>

namespace itin {

class DecodedText {
 public:
  /// `file` must outlive it; `name` is for messages. Throws FileError where the file cannot be read.
  DecodedText(std::istream& file, std::string name);

  /// Reads up to `most` bytes; returns how many, 0 only at the end of the file. Precondition: most is 4 or more. Throws
  /// FileError.
  std::size_t read(char* to, std::size_t most);
  /// The bytes of the file that have been read.
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  enum class Encoding { kBytes, kLittleEndian, kBigEndian };

  Encoding encoding_of_start();
  std::size_t read_bytes(char* to, std::size_t most);
  std::optional<char32_t> next_unit();
  std::optional<char32_t> next_character();

  std::istream& file_;
  std::string name_;
  std::uint64_t bytes_read_ = 0;
  std::string ahead_;  ///< read to tell the encoding, not handed on yet
  Encoding encoding_;
};

}  // namespace itin
