// Certified viewsheds, made in the way that has been chosen.
#pragma once

#include <viewshed/viewshed.hpp>

#include "plan/certified_way.hpp"

namespace itin::viewshed {

/// Computes as the compute_certified() that takes certified_way() of its request, but in the given way.
ViewshedWithSurface compute_certified(const Store& store, const Request& request, CertifiedWay way,
                                      const ComputeOptions& options, Progress& progress);

}  // namespace itin::viewshed
