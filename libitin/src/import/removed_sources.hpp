// Finds what an import is to take out of a store.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>

#include "pyramid/points/source_index.hpp"

namespace itin {

/// Returns the sources of features that stand, by number, that these names mean: of all of a theme, or of all files of
/// that name. The store may be null. Throws InputError for a name that means none.
Sources removed_sources(const std::vector<std::string>& names, const Store* store);

}  // namespace itin
