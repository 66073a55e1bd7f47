// What lies near an observer, decided exactly: there a coarse level decides least, and people look first.
#pragma once

#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

#include "judge/block_judge.hpp"

namespace itin::viewshed {

/// Decides cells of `grid`; nothing where none lies that near. Adds the lines that it takes to the statistics. Throws
/// as compute_with_surface() does.
std::optional<ExactNearby> decide_nearby(const Store& store, const Request& request, const Observer& observer,
                                         const RasterGrid& grid, Statistics& statistics, Progress& progress);

}  // namespace itin::viewshed
