// The themes and features of a viewshed over a store.
#pragma once

#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// What the store that a result was made of knows of it: the names of its themes, and of its blockers which features
/// they are part of.
void name_features(const Store& store, Result& result);

}  // namespace itin::viewshed
