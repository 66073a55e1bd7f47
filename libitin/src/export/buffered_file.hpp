// A new file written in large pieces; every error is noticed.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "export/pending_file.hpp"

namespace itin {

class BufferedFile {
 public:
  /// Creates output.temporary_path(). Throws FileError, as all functions here do; errors name output.path().
  explicit BufferedFile(const PendingFile& output);

  void write(std::string_view bytes) {
    buffer_.append(bytes);
    flush_if_large();
  }
  template <std::integral T>
  void little_endian(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) buffer_.push_back(static_cast<char>(value >> (8 * i)));
    flush_if_large();
  }
  void little_endian(float value) { little_endian(std::bit_cast<std::uint32_t>(value)); }
  void little_endian(double value) { little_endian(std::bit_cast<std::uint64_t>(value)); }
  /// Prints as fmt::print() does; doubles become the shortest decimals that read back as the same.
  template <typename... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    flush_if_large();
  }
  /// Completes the file. This or close_synced() must be called: without it the end of the file is missing.
  void close();
  /// Completes the file, and waits until it is on disk.
  void close_synced();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  static constexpr std::size_t kLarge = std::size_t{1} << 18;

  void flush_if_large() {
    if (buffer_.size() >= kLarge) flush();
  }
  void flush();
  [[noreturn]] void fail() const;

  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
  fmt::basic_memory_buffer<char, 2 * kLarge> buffer_;
};

}  // namespace itin
