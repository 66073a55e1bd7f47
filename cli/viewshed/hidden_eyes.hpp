// Observers whose eyes are within what stands on the ground.
#pragma once

#include <string>
#include <vector>

#include <itin/detail.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::cli {

/// Warns of observers on the ground that are within a feature of the surface of this detail and lower than its top:
/// they see nothing but their own place.
void warn_of_hidden_eyes(const Store& store, const viewshed::Result& result, const Detail& detail,
                         std::vector<std::string>& warnings);

}  // namespace itin::cli
