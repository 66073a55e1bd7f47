// Footprints as they were imported, kept so that raised features can be built again when the terrain under them
// changes. See libitin/FORMAT.md, "Footprint block".
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <itin/store.hpp>

#include "store/segments/footprint.hpp"

namespace itin {

struct StoredFootprint {
  FootprintFeature feature;
  std::uint16_t source = 0;
};

/// Returns the footprints of a theme, by its number, in the order of their numbers. Throws CorruptStore.
std::vector<StoredFootprint> stored_footprints(const Store& store, std::uint16_t theme);
/// Returns the footprints in one of the theme's footprint_blocks.
std::vector<StoredFootprint> stored_footprints(const Store& store, std::uint16_t theme, std::uint32_t block);

/// Calls visit(number, footprint) for each of a theme's footprints, in the order of their numbers, one block in memory
/// at a time.
template <class Visit>
void for_each_footprint(const Store& store, std::uint16_t theme, const Visit& visit) {
  std::int64_t number = 0;
  const std::uint32_t blocks = store.metadata().themes[theme - std::size_t{1}].footprint_blocks;
  for (std::uint32_t block = 0; block < blocks; ++block)
    for (const StoredFootprint& footprint : stored_footprints(store, theme, block)) visit(number++, footprint);
}

inline constexpr std::size_t kFootprintsInBlock = 256;

/// Calls visit(i, footprint) for each of these numbers that the theme has, the i-th of them; each block is read once.
template <class Visit>
void for_each_footprint_numbered(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers,
                                 const Visit& visit) {
  const std::uint32_t blocks = store.metadata().themes[theme - std::size_t{1}].footprint_blocks;
  std::map<std::uint32_t, std::vector<std::size_t>> wanted;  // places among the numbers, by block
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint64_t block = static_cast<std::uint64_t>(numbers[i]) / kFootprintsInBlock;
    if (numbers[i] >= 0 && block < blocks) wanted[static_cast<std::uint32_t>(block)].push_back(i);
  }
  for (const auto& [block, places] : wanted) {
    const std::vector<StoredFootprint> footprints = stored_footprints(store, theme, block);
    for (const std::size_t i : places) {
      const std::size_t place = static_cast<std::size_t>(numbers[i]) % kFootprintsInBlock;
      if (place < footprints.size()) visit(i, footprints[place]);
    }
  }
}

std::vector<std::uint8_t> encode_footprints(std::span<const StoredFootprint> footprints);
/// Returns the bytes of one feature, without its source and not compressed. They order features independently of the
/// order of import.
std::vector<std::uint8_t> content_of(const FootprintFeature& feature);
/// Decodes a block. Throws DecodeError.
std::vector<StoredFootprint> decode_footprints(std::span<const std::uint8_t> bytes);

}  // namespace itin
