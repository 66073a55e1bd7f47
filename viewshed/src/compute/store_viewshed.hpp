// Viewsheds over what is retrieved of a store as a whole.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Whether its mode asks more of the surface than sight lines.
bool needs_tin(const Request& request);

/// Where the surface is a lattice of at most so many posts, and the mode and the detail are such that it will do. The
/// request is valid.
std::optional<Surveyed> compute_over_lattice(const Store& store, const Request& request, std::uint64_t most_posts,
                                             Progress& progress);

/// Of every surface, mode and detail.
Surveyed compute_over_tin(const Store& store, const Request& request, Progress& progress);

}  // namespace itin::viewshed
