// Values written one after the other as bytes, and read back, on machines with the same order of bytes.
//
//   ValueWriter writer;
//   exchange_fields(writer, result);                 // exchange_fields() names every field once, for both directions:
//   ...                                       //   template <class Archive, class R>
//   ValueReader reader(bytes);                 //   void exchange_fields(Archive& archive, R& r) { archive(r.count,
//   r.names); } exchange_fields(reader, result); reader.expect_end();
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace itin {

/// The bytes are not those that a ValueWriter has written of these values.
struct NotThoseValues : std::runtime_error {
  NotThoseValues() : std::runtime_error("other bytes than those of these values") {}
};

template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A value that names its fields by exchange_fields(archive, value).
template <class T, class Archive>
concept Exchangeable = requires(Archive& archive, T& value) {
  exchange_fields(archive, value);
};

class ValueWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <PlainValue T>
  void put(const T& v) {
    append(&v, sizeof v);
  }
  void put(const std::string& v) { put_all(v); }
  template <class T>
  requires Exchangeable<const T, ValueWriter>
  void put(const T& v) { exchange_fields(*this, v); }
  template <class T>
  void put(const std::vector<T>& all) {
    if constexpr (PlainValue<T>) return put_all(all);
    put(std::uint64_t{all.size()});
    for (const T& v : all) put(v);
  }
  void put_all(const auto& all) {
    put(std::uint64_t{all.size()});
    append(all.data(), all.size() * sizeof *all.data());
  }
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_;
};

/// Throws NotThoseValues where the bytes end too early, or do not end where they should.
class ValueReader {
 public:
  /// The bytes must outlive the reader.
  explicit ValueReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  void expect_end() const {
    if (at_ != bytes_.size()) throw NotThoseValues();
  }

 private:
  template <PlainValue T>
  void get(T& v) {
    take(&v, sizeof v);
  }
  void get(std::string& v) { get_all(v); }
  template <class T>
  requires Exchangeable<T, ValueReader>
  void get(T& v) { exchange_fields(*this, v); }
  template <class T>
  void get(std::vector<T>& all) {
    if constexpr (PlainValue<T>) return get_all(all);
    all.resize(count(1));
    for (T& v : all) get(v);
  }
  void get_all(auto& all) {
    all.resize(count(sizeof *all.data()));
    take(all.data(), all.size() * sizeof *all.data());
  }
  /// Reads a count of values that take at least `size` bytes each.
  std::size_t count(std::size_t size) {
    std::uint64_t n = 0;
    get(n);
    if (n > (bytes_.size() - at_) / size) throw NotThoseValues();
    return n;
  }
  void take(void* data, std::size_t size) {
    if (size > bytes_.size() - at_) throw NotThoseValues();
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace itin
