// The themes and features of a viewshed over a store.
#pragma once

#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Takes names from the store that the result was made of: those of its themes, and the features that its blockers are
/// part of.
void name_features(const Store& store, Result& result);

}  // namespace itin::viewshed
