#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

Eye eye_at(const Grid& grid, const Request& request, const SitePosition& place) {
  return eye_of(grid, request, {place.name, place.position, place.elevation(), true}, place.ground);
}

std::vector<Eye> eyes_of(const Grid& grid, const SiteSurvey& survey, const SitesToJudge& sites) {
  std::vector<Eye> eyes;
  for (const std::size_t option : sites.options) eyes.push_back(eye_at(grid, sites.request, survey.positions[option]));
  return eyes;
}

Request request_of(const SiteSurvey& survey, std::span<const std::size_t> options) {
  Request request;
  for (const std::size_t option : options) {
    const SitePosition& place = survey.positions[option];
    request.observers.push_back({place.name, place.position, place.elevation(), true});
  }
  request.target_height = survey.targets.height;
  request.radius = survey.radius;
  request.earth = survey.earth;
  request.nodata = survey.nodata;
  return request;
}

}  // namespace itin::viewshed
