// What is under the cursor: how it lies from a view's first observer, whether it is seen, and what hides it.
#pragma once

#include <itin/document.hpp>
#include <itin/geometry.hpp>

#include "serve/served_store.hpp"

namespace itin::cli {

/// The answer to a probe at a position in the store's CRS, as PROTOCOL.md describes it. `options` are those of the
/// view. Throws InputError, also where there is no ground, and what profile::analyse() throws.
Document probe_answer(const ServedStore& served, const Document& options, Point2 position);

}  // namespace itin::cli
