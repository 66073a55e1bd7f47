// Reads little-endian numbers from bytes, one after the other.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace itin::test {

/// Runs on little-endian hosts only, as the tests do.
class BinaryReader {
 public:
  explicit BinaryReader(std::string_view bytes) : rest_(bytes) {}
  template <typename T>
  T read() {
    T value;
    const std::string_view bytes = take(sizeof(T));
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throw std::runtime_error("the file ends too early");
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

}  // namespace itin::test
