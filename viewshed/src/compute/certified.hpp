// Certified viewsheds, the way that has been chosen.
#pragma once

#include <viewshed/viewshed.hpp>

#include "plan/certified_way.hpp"

namespace itin::viewshed {

/// As compute_certified(), which goes by certified_way() of its request.
ViewshedWithSurface compute_certified(const Store& store, const Request& request, CertifiedWay way,
                                      const ComputeOptions& options, Progress& progress);

}  // namespace itin::viewshed
