// A visibility index by targets at random, over any surface.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_part.hpp"

namespace itin::viewshed {

/// Draws the layout's targets. Precondition: it has some. Throws as index_part() does.
IndexPart index_part_by_targets(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                                const CellRectangle& cells, Progress& progress);

}  // namespace itin::viewshed
