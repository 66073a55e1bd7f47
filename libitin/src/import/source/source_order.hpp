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

}  // namespace itin
