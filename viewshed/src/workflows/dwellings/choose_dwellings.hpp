// Which dwellings are studied: buildings of the store, or given places.
//
//   const std::vector<Dwelling> chosen = choose_dwellings(request, metadata, feet, progress);
#pragma once

#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// Chooses the dwellings within reach of a turbine, without facades, and buildings without names of their own. `feet`
/// are the buildings of the chosen themes. Throws InputError where there is none, and where a turbine stands within a
/// building; Cancelled.
std::vector<Dwelling> choose_dwellings(const DwellingsRequest& request, const StoreMetadata& metadata,
                                       const std::vector<BuildingFoot>& feet, const Progress& progress);

/// How far the turbine's shadow reaches, metres; 0 where its rotor is not known.
double shadow_reach(const FlickerRules& rules, const Turbine& turbine);

/// Tells whether the turbine's shadow may reach a place: never where its rotor is not known.
bool may_shade(const FlickerRules& rules, const Turbine& turbine, Point2 place);

}  // namespace itin::viewshed
