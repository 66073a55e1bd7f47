// Which of a store's levels a query reads.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>

namespace itin {

/// Returns the coarsest level whose tolerance is at most this one.
int level_within(const StoreMetadata& metadata, double tolerance);

/// Returns the finest level, from `finest` on, with at most about `most_points` in the box; the coarsest where none has
/// so few.
int finest_level_of(const Store& store, const Box& box, std::uint64_t most_points, int finest = 0);

/// Returns the detail that reads the surface of one level.
Detail detail_of(const StoreMetadata& metadata, int level);

/// Returns the widest certified error of the levels that this detail reads.
CertifiedError certified_error(const StoreMetadata& metadata, const Detail& detail);

}  // namespace itin
