// Features whose outlines cross each other so often that they are not taken apart.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "features/footprint_arrangement.hpp"

namespace itin {

/// The owners of patches that are to go, and why, so that the outlines of all others meet each other at no more than
/// most_conflicts() places (planarity.hpp): those that cross others most often go first, of equals the last. None where
/// there are no more to begin with. `owners` by patch. Memory is bounded whatever the outlines.
std::map<std::uint32_t, std::string> entangled(std::span<const Patch> patches, std::span<const std::uint32_t> owners);

}  // namespace itin
