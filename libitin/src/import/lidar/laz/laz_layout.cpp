#include "import/lidar/laz/laz_layout.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "base/file_bytes.hpp"

namespace itin {

namespace {

constexpr std::size_t kRecordHead = 34, kItemBytes = 6;
constexpr std::uint16_t kChunks = 2, kLayeredChunks = 3;  // what the record calls its compressor
constexpr std::uint32_t kChunksVary = 0xffffffff;

/// The parts of a point, by the numbers that the format has for them.
enum class Part : std::uint16_t {
  kBytes = 0,
  kPoint = 6,
  kTime = 7,
  kColour = 8,
  kModernPoint = 10,
  kModernColour = 11,
  kColourAndInfrared = 12,
  kModernWaveform = 13,
  kModernBytes = 14
};

struct Item {
  Part part;
  std::uint16_t size = 0, version = 0;
};

[[noreturn]] void refuse_laz(const std::string& path, const std::string& why) {
  throw FileError(path, why + "; convert it with `las2las -i in.laz -o out.las` or `pdal translate in.laz out.las`");
}

std::vector<Item> laz_items(const std::string& path, std::span<const char> record) {
  const std::size_t count = record.size() < kRecordHead ? 0 : little_endian<std::uint16_t>(&record[kRecordHead - 2]);
  if (count == 0 || record.size() < kRecordHead + count * kItemBytes)
    throw FileError(path, fmt::format("a LASzip record of {} bytes is damaged", record.size()));
  std::vector<Item> items;
  for (std::size_t i = 0; i < count; ++i) {
    const char* const item = &record[kRecordHead + i * kItemBytes];
    items.push_back({static_cast<Part>(little_endian<std::uint16_t>(item)), little_endian<std::uint16_t>(item + 2),
                     little_endian<std::uint16_t>(item + 4)});
  }
  return items;
}

/// How many layers a part of a layered point has; 0 for parts that have none.
std::uint32_t layers_of(const Item& item) {
  switch (item.part) {
    case Part::kModernPoint:
      return 9;
    case Part::kModernColour:
    case Part::kModernWaveform:
      return 1;
    case Part::kColourAndInfrared:
      return 2;
    case Part::kModernBytes:
      return item.size;
    default:
      return 0;
  }
}

/// Takes a part of a point that is not layered. Returns whether there is such a part, in this version.
bool take_plain(const Item& item, LazLayout& layout) {
  if (item.part == Part::kTime) layout.times = true;
  if (item.part == Part::kColour) layout.colours = true;
  if (item.part == Part::kBytes) layout.extra_bytes += item.size;
  const bool known =
      item.part == Part::kPoint || item.part == Part::kTime || item.part == Part::kColour || item.part == Part::kBytes;
  return known && item.version == 2;
}

/// Takes a part of a layered point, likewise.
bool take_layered(const Item& item, LazLayout& layout) {
  layout.layers += layers_of(item);
  return layers_of(item) > 0 && (item.version == 3 || item.version == 4);
}

}  // namespace

LazLayout laz_layout(const std::string& path, std::span<const char> record, const LazRecord& point) {
  const std::vector<Item> items = laz_items(path, record);
  const auto compressor = little_endian<std::uint16_t>(record.data()), coder = little_endian<std::uint16_t>(&record[2]);
  if ((compressor != kChunks && compressor != kLayeredChunks) || coder != 0)
    refuse_laz(path, fmt::format("compressed (LAZ) in a way, {} by {}, that is not read", compressor, coder));
  LazLayout layout;
  layout.layered = compressor == kLayeredChunks;
  layout.chunk_points = little_endian<std::uint32_t>(&record[12]);
  if (layout.chunk_points == 0) throw FileError(path, "the LASzip record has chunks of no points; it is damaged");
  if (layout.chunk_points == kChunksVary) layout.chunk_points = 0;
  for (const Item& item : items) {
    layout.record_length += item.size;
    if (!(layout.layered ? take_layered(item, layout) : take_plain(item, layout)))
      refuse_laz(path, fmt::format("compressed (LAZ) with a part {} of version {} in each point, which is not read",
                                   static_cast<int>(item.part), item.version));
  }
  const Part first = layout.layered ? Part::kModernPoint : Part::kPoint;
  const bool fits = items.front().part == first && layout.layered == (point.format >= 6) &&
                    layout.record_length == point.length &&
                    std::count_if(items.begin(), items.end(), [&](const Item& i) { return i.part == first; }) == 1;
  if (!fits)
    throw FileError(path, fmt::format("the LASzip record does not fit points of format {} and {} bytes; it is damaged",
                                      point.format, point.length));
  return layout;
}

}  // namespace itin
