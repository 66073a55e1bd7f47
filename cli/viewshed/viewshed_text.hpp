// What `itin viewshed` prints for people.
#pragma once

#include <string>

#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::cli {

/// How many cells have which verdict, on which surface, what would decide the others, what has no ground data, and what
/// that took; a line each.
std::string viewshed_text(const StoreMetadata& metadata, const viewshed::Result& result,
                          const viewshed::MissingGround& missing);

}  // namespace itin::cli
