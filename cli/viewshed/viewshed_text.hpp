// Writes the text that `itin viewshed` prints for people.
#pragma once

#include <string>

#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result.hpp>

namespace itin::cli {

/// Tells, in a line each, the number of cells by verdict, the surface, what would decide the other cells, what has no
/// ground data, and the work that all of it took.
std::string viewshed_text(const StoreMetadata& metadata, const viewshed::Result& result,
                          const viewshed::MissingGround& missing);

}  // namespace itin::cli
