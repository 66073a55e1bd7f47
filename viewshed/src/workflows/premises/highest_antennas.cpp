#include "workflows/premises/highest_antennas.hpp"

#include "places/mount_places.hpp"
#include "workflows/premises/each_building.hpp"

namespace itin::viewshed {

namespace {

std::vector<HighestAntenna> highest_of(const MountPlaces& places, const PlacedSurface& ground,
                                       const AntennaPlaces& antennas) {
  std::vector<HighestAntenna> highest;
  for (const WallPlace& wall : places.walls)
    highest.push_back({wall.position, mount_heights(wall, antennas.storey).back()});
  for (const RoofPlace& place : places.roof)
    if (const auto bare = ground.height(place.position))
      highest.push_back({place.position, place.roof_m + antennas.poles.back() - *bare});
  return highest;
}

}  // namespace

std::vector<std::vector<HighestAntenna>> highest_antennas(const Store& store, const PremisesRequest& request,
                                                          const std::vector<BuildingFoot>& feet, Progress& progress) {
  std::vector<std::vector<HighestAntenna>> antennas(feet.size());
  Statistics statistics;
  for_each_building(store, request, feet, {"places of antennas", statistics}, progress,
                    [&](std::size_t i, const StandingBuilding& building) {
                      antennas[i] = highest_of(mount_places(building, progress), building.ground, request);
                    });
  return antennas;
}

}  // namespace itin::viewshed
