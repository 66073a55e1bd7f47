// Warns about features that stand: all findings about features of this import, but only new ones about older features.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/store.hpp>

#include "import/vectors/line_collection.hpp"

namespace itin {

/// Warns about features of the sources that were added, given by their numbers, and about themes of which fewer
/// features stand than in the store before, because the ground has changed. `before` may be null.
std::vector<std::string> raised_warnings(const RaisedFeaturesReport& raised, const StoreMetadata* before,
                                         const std::vector<std::uint16_t>& added);

}  // namespace itin
