// The full surface, with what stands on it, reduced to what a first look from very many sites needs: how low and how
// high it is within bins, and how high the ground under each target is. It is made once for all sites, piece by piece,
// so that the memory need not hold the surface itself.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

#include "bounds/surface_bins.hpp"

namespace itin::viewshed {

struct SurveyBins {
  SurfaceBins bins;
  /// The ground's height under each cell of the targets' grid, row by row, or under each point; grid units, kNoSurface
  /// where there is no ground.
  std::vector<double> ground;
};

/// Bins the surface within the radius of any site. `bytes` is the memory for the bins and for what is read at once; the
/// bins are as narrow as it allows, but no narrower than half a metre. Throws as triangulate() does.
SurveyBins bin_surface(const Store& store, const SiteSurvey& survey, std::uint64_t bytes, Statistics& statistics,
                       Progress& progress);

}  // namespace itin::viewshed
