// What a request says in more than one field: its masts, what is open, which sites may stand beside each other, what
// places are called.
#pragma once

#include <string>
#include <vector>

#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns the masts that a candidate without a height may have; for turbines one, as high as what is looked for.
inline std::vector<Mast> masts_of(const SitePlanRequest& request) {
  if (request.turbines) return {{request.turbines->minimised_height(), 1}};
  return request.masts;
}

/// Returns what targets count as that only ground without data could hide: turbines are hidden in the worst case.
inline OpenTargets open_targets(const SitePlanRequest& request) {
  return request.turbines ? OpenTargets::kServed : OpenTargets::kUnserved;
}

/// Tells whether there is a result for each point of the demand: where masts serve points.
inline bool tells_points(const SitePlanRequest& request) {
  return request.demand.points && !request.turbines;
}

/// Tells whether distances between chosen sites matter.
inline bool has_spacing(const SitePlanRequest& request) {
  return request.min_spacing || (request.turbines && request.turbines->spacing);
}

/// Tells whether sites at both places may be chosen, as far as distances go.
inline bool may_both_stand(const SitePlanRequest& request, Point2 a, Point2 b) {
  if (request.min_spacing && distance(a, b) < *request.min_spacing) return false;
  return !request.turbines || !request.turbines->spacing || request.turbines->spacing->keeps_apart(a, b);
}

/// Returns what messages call a list of places: its source, or else `what` the places are.
inline std::string name_of(const SitePlaces& places, const char* what) {
  return places.source.empty() ? what : places.source;
}

/// Returns what messages call a place of the list: where it stands in the source, or else its name.
inline std::string name_of(const SitePlaces& places, const char* what, const SitePlace& place) {
  return place.origin.empty() ? name_of(places, what) + " " + place.name : name_of(places, what) + ": " + place.origin;
}

}  // namespace itin::viewshed
