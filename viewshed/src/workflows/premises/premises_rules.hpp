// What a request for premises must hold, and the rules that its buildings follow.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/store.hpp>
#include <viewshed/premises.hpp>

#include "places/mount_places.hpp"

namespace itin::viewshed {

/// Checks the places of antennas, and sorts their poles; with a frequency leaves out poles of 0. Throws InputError.
void complete_antennas(AntennaPlaces& antennas, std::optional<double> frequency_ghz);

/// Warns of buildings of the chosen themes that the import left out.
void warn_of_left_out(const StoreMetadata& metadata, const ThemeChoice& themes, std::vector<std::string>& warnings);

/// Checks that the chosen buildings stand on the ground. Warns of those that do not. Throws InputError.
void require_buildings(const StoreMetadata& metadata, const ThemeChoice& themes, std::vector<std::string>& warnings);

/// Returns the rules for the places of a building.
MountRules mount_rules(const PremisesRequest& request, const StoreMetadata& metadata, const BuildingFoot& foot);

/// Returns the box about a building, the antennas before its walls, and its street.
Box box_about(const PremisesRequest& request, const BuildingFoot& foot);

}  // namespace itin::viewshed
