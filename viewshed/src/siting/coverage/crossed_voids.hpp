// Whether ground without data matters to a survey of sites.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// Tells whether a sight line from a site to a place within the radius may cross ground without data. Reads the outline
/// of the data about all sites.
bool sites_may_cross_voids(const Store& store, const SiteSurvey& survey, Progress& progress);

}  // namespace itin::viewshed
