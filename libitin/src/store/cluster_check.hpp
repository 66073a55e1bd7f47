// Checks that the boxes of clusters agree between the segments and the vertices of a part.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "store/store_file.hpp"

namespace itin {

/// Returns the blocks of segments whose clusters are not also clusters of both of their ends: a query that has a
/// segment has both of its ends. Throws CorruptStore where a block cannot be read, Cancelled.
std::vector<Damage> false_clusters(const StoreFile& file, const Progress& progress);

}  // namespace itin
