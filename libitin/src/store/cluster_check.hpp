// Whether the boxes of clusters hold what the segments and the vertices of a part say of them.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "store/store_file.hpp"

namespace itin {

/// A segment has both of its ends wherever a query has it, so these are of its clusters too. Of blocks that can be
/// read, names those that say otherwise. Throws CorruptStore where one cannot, Cancelled.
std::vector<Damage> false_clusters(const StoreFile& file, const Progress& progress);

}  // namespace itin
