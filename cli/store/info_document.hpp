// What a store holds, as a JSON document.
#pragma once

#include <itin/document.hpp>
#include <itin/stated_heights.hpp>
#include <itin/store.hpp>

namespace itin::cli {

/// The document of `itin info`, without the version and the call.
Document info_document(const Store& store, const StatedHeights& heights);

double bytes_per_vertex(const Store& store);

}  // namespace itin::cli
