// Sources in an order that knows no order of import: it decides wherever several could claim the same place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/store.hpp>

namespace itin {

/// The rank of each source: those that are ground by themselves come first, the sea last, then what they hold decides.
/// Equal ranks are of equal sources.
std::vector<std::uint32_t> ranks_of(std::span<const SourceInfo> sources);

}  // namespace itin
