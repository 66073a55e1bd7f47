#include "siting/coverage/crossed_voids.hpp"

#include <algorithm>

#include "bounds/boundary.hpp"
#include "request/void_shadow.hpp"
#include "siting/coverage/site_window.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

bool sites_may_cross_voids(const Store& store, const SiteSurvey& survey, Progress& progress) {
  const Tin ground = coverage_of(store, Window::box(reach_of(survey)), progress);
  const std::vector<RimEdge> rim = rim_of(ground, boundary_edges(ground));
  return std::any_of(survey.positions.begin(), survey.positions.end(), [&](const SitePosition& place) {
    return may_cross_voids(ground.grid, rim, place.position, survey.radius);
  });
}

}  // namespace itin::viewshed
