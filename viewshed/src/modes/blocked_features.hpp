// Which imported features hide cells.
#pragma once

#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Fills blocker_feature of a result whose blockers are triangles of `tin`, from the store it was made of.
void find_blocking_features(const Store& store, const Tin& tin, Result& result);

}  // namespace itin::viewshed
