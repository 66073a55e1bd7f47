// The triangulation of what a Selection has of a store: what triangulate() makes of a Detail and a choice of themes.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

#include "triangulate/apex/selection.hpp"

namespace itin {

/// Costs and throws as triangulate() does.
Tin triangulate_selected(const Store& store, const Window& window, const Selection& selection, Progress& progress);

}  // namespace itin
