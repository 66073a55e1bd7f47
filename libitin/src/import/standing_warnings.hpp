// What an import says of features that stand: of its own all, of older ones what is new.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>

#include "import/vectors/line_collection.hpp"

namespace itin {

/// Of features of the sources from number `first_new` on, and of themes of which fewer features stand than in the store
/// before: the ground has become another. `before` may be null.
std::vector<std::string> standing_warnings(const RaisedFeatures& raised, const StoreMetadata* before,
                                           std::size_t first_new);

}  // namespace itin
