// Features whose outlines cross each other so often that they are not taken apart.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "features/mesh/footprint_arrangement.hpp"

namespace itin {

/// Chooses owners to leave out, so that the outlines of all others meet each other at no more than most_conflicts()
/// places (planarity.hpp). Returns these owners and the reasons. The owner that crosses others most often goes first;
/// among equals, the one with the greatest number. The result is empty where outlines meet no more often to begin with.
/// `owners` holds the owner of each patch. Memory is bounded whatever the outlines.
std::map<std::uint32_t, std::string> entangled(std::span<const Patch> patches, std::span<const std::uint32_t> owners);

}  // namespace itin
