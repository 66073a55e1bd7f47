// The bytes of a binary file by their offset, each access checked against the file's size, so that truncated and
// damaged files end in a FileError that names the offset.
//
//   FileBytes bytes(path);
//   std::array<char, 4> word;
//   bytes.read(offset, word, "the point data");
//   const auto count = little_endian<std::uint32_t>(word.data());
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace itin {

/// Reads a number that is written with its lowest byte first.
template <class T, class Byte>
T little_endian(const Byte* bytes) {
  static_assert(sizeof(Byte) == 1);
  T value;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&value, bytes, sizeof value);
  } else {
    std::array<Byte, sizeof(T)> reversed;
    std::reverse_copy(bytes, bytes + sizeof value, reversed.begin());
    std::memcpy(&value, reversed.data(), sizeof value);
  }
  return value;
}

class FileBytes {
 public:
  /// `path` must outlive it. Throws FileError.
  explicit FileBytes(const std::string& path);

  std::uint64_t size() const { return size_; }
  /// Fills `out`. `what` is what is read, for messages. Throws FileError.
  void read(std::uint64_t offset, std::span<char> out, std::string_view what);
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const;

 private:
  const std::string& path_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

}  // namespace itin
