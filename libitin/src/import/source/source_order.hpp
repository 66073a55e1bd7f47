// Orders sources without regard to the order of import. The order decides wherever several could claim the same place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/store.hpp>

namespace itin {

/// The rank of each source. Sources that are ground by themselves come first and the sea last; then what the sources
/// hold decides. Only equal sources have equal ranks.
std::vector<std::uint32_t> ranks_of(std::span<const SourceInfo> sources);

/// Stands for the number of a source that is not in the store any more.
inline constexpr std::uint16_t kNoSource = 0xffff;

/// The numbers that sources have in a store, whatever the order in which they were imported: sources of points come
/// first, so that features come and go without a change to the ground's points. Takes the sources in any order, and
/// whether each is to be left out. Returns the number of each, or kNoSource.
std::vector<std::uint16_t> numbers_of(std::span<const SourceInfo> sources, const std::vector<bool>& left_out);

}  // namespace itin
