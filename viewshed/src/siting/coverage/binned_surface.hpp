// The full surface, with what stands on it, as little as a first look from very many sites needs to know of it: how low
// and how high it is within bins, and how high the ground under each target is. It is made once for all sites, piece by
// piece, so that the memory need not hold the surface itself.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

#include "bounds/surface_bins.hpp"

namespace itin::viewshed {

struct BinnedSurface {
  SurfaceBins bins;
  /// Under each cell of the targets' grid, row by row, or each point; grid units, kNoSurface where there is none.
  std::vector<double> ground;
};

/// What lies within the radius of a site; the bins are as narrow as so many bytes allow, for them and what is read at
/// once, but no narrower than half a metre. Throws as triangulate() does.
BinnedSurface bin_surface(const Store& store, const SiteSurvey& survey, std::uint64_t bytes, Statistics& statistics,
                          Progress& progress);

}  // namespace itin::viewshed
