// Certified viewsheds, made in the way that has been chosen.
#pragma once

#include <viewshed/viewshed.hpp>

#include "plan/certified_way.hpp"

namespace itin::viewshed {

/// Computes as the public compute_certified() does, but in the given way in place of certified_way()'s.
ViewshedWithSurface compute_certified(const Store& store, const Request& request, CertifiedWay way,
                                      const ComputeOptions& options, Progress& progress);

}  // namespace itin::viewshed
