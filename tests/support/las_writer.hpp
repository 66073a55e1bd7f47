// LAS files of every version and point format, as bytes, for tests of the reader. They follow the ASPRS specification.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace itin::test {

struct LasRecord {
  std::int32_t x = 0, y = 0, z = 0;  ///< before scale and offset
  std::uint8_t classification = 0;
  bool withheld = false;
};

struct LasVariableRecord {
  std::string user = "LASF_Projection";
  std::uint16_t id = 0;
  std::string payload;
};

struct LasContents {
  int minor_version = 2;
  int point_format = 1;
  int extra_bytes = 0;  ///< behind each point
  bool wkt_bit = false;
  bool legacy_count_only = false;  ///< in 1.4
  std::array<double, 3> scale{0.01, 0.01, 0.01}, offset{0, 0, 0};
  std::vector<LasVariableRecord> vlrs, evlrs;
  std::vector<LasRecord> points;
};

/// Writes little-endian bytes at the end of a string, or in place.
class LittleEndian {
 public:
  template <class T>
  static void put(std::string& bytes, std::size_t offset, T value) {
    std::uint64_t bits = 0;
    if constexpr (sizeof(T) == 8)
      bits = std::bit_cast<std::uint64_t>(value);
    else
      bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes.at(offset + i) = static_cast<char>(bits >> (8 * i) & 0xff);
  }
  template <class T>
  static T get(const std::string& bytes, std::size_t offset) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes.at(offset + i))) << (8 * i);
    return static_cast<T>(bits);
  }
  template <class T>
  static void append(std::string& bytes, T value) {
    bytes.resize(bytes.size() + sizeof(T));
    put(bytes, bytes.size() - sizeof(T), value);
  }
};

/// A key directory whose values are codes.
inline std::string geo_key_directory(const std::vector<std::array<std::uint16_t, 2>>& keys) {
  std::string bytes;
  for (const auto v : {std::uint16_t{1}, std::uint16_t{1}, std::uint16_t{0}, static_cast<std::uint16_t>(keys.size())})
    LittleEndian::append(bytes, v);
  for (const auto& [key, value] : keys)
    for (const auto v : {key, std::uint16_t{0}, std::uint16_t{1}, value}) LittleEndian::append(bytes, v);
  return bytes;
}

inline std::string variable_record(const LasVariableRecord& record, bool extended) {
  std::string bytes(18, '\0');
  bytes.replace(2, record.user.size(), record.user);
  LittleEndian::append(bytes, record.id);
  if (extended)
    LittleEndian::append(bytes, static_cast<std::uint64_t>(record.payload.size()));
  else
    LittleEndian::append(bytes, static_cast<std::uint16_t>(record.payload.size()));
  return bytes + std::string(32, '\0') + record.payload;
}

inline std::string point_record(const LasContents& las, const LasRecord& point) {
  constexpr std::array<std::size_t, 11> kLengths = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  // Fields that the reader must not look at are filled, so that a wrong offset shows.
  std::string bytes(kLengths.at(static_cast<std::size_t>(las.point_format)), '\x5a');
  LittleEndian::put(bytes, 0, point.x);
  LittleEndian::put(bytes, 4, point.y);
  LittleEndian::put(bytes, 8, point.z);
  if (las.point_format >= 6) {
    bytes[15] = static_cast<char>(0x5b & ~0x04) | static_cast<char>(point.withheld ? 0x04 : 0);
    bytes[16] = static_cast<char>(point.classification);
  } else {
    bytes[15] = static_cast<char>((point.classification & 0x1f) | 0x40 | (point.withheld ? 0x80 : 0));
  }
  return bytes + std::string(static_cast<std::size_t>(las.extra_bytes), '\x77');
}

inline std::string las_bytes(const LasContents& las) {
  const std::size_t header_size = las.minor_version == 4 ? 375 : las.minor_version == 3 ? 235 : 227;
  std::string vlrs, points, evlrs;
  for (const auto& record : las.vlrs) vlrs += variable_record(record, false);
  for (const auto& record : las.evlrs) evlrs += variable_record(record, true);
  for (const auto& point : las.points) points += point_record(las, point);

  std::string header(header_size, '\0');
  header.replace(0, 4, "LASF");
  LittleEndian::put(header, 6, static_cast<std::uint16_t>(las.wkt_bit ? 0x10 : 0));
  header[24] = 1;
  header[25] = static_cast<char>(las.minor_version);
  LittleEndian::put(header, 94, static_cast<std::uint16_t>(header_size));
  LittleEndian::put(header, 96, static_cast<std::uint32_t>(header_size + vlrs.size()));
  LittleEndian::put(header, 100, static_cast<std::uint32_t>(las.vlrs.size()));
  header[104] = static_cast<char>(las.point_format);
  LittleEndian::put(header, 105, static_cast<std::uint16_t>(point_record(las, {}).size()));
  const bool modern_count = las.minor_version == 4 && !las.legacy_count_only;
  LittleEndian::put(header, 107, static_cast<std::uint32_t>(modern_count ? 0 : las.points.size()));
  std::array<double, 3> low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LittleEndian::put(header, 131 + 8 * axis, las.scale[axis]);
    LittleEndian::put(header, 155 + 8 * axis, las.offset[axis]);
    bool first = true;
    for (const auto& p : las.points) {
      const double value = std::array{p.x, p.y, p.z}[axis] * las.scale[axis] + las.offset[axis];
      low[axis] = first || value < low[axis] ? value : low[axis];
      high[axis] = first || value > high[axis] ? value : high[axis];
      first = false;
    }
    LittleEndian::put(header, 179 + 16 * axis, high[axis]);
    LittleEndian::put(header, 187 + 16 * axis, low[axis]);
  }
  if (las.minor_version == 4) {
    LittleEndian::put(header, 235, static_cast<std::uint64_t>(header_size + vlrs.size() + points.size()));
    LittleEndian::put(header, 243, static_cast<std::uint32_t>(las.evlrs.size()));
    LittleEndian::put(header, 247, static_cast<std::uint64_t>(modern_count ? las.points.size() : 0));
  }
  return header + vlrs + points + evlrs;
}

}  // namespace itin::test
