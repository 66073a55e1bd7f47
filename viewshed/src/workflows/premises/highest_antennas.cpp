#include "workflows/premises/highest_antennas.hpp"

#include <utility>

#include "places/mount_places.hpp"
#include "progress/stage.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"
#include "workflows/premises/premises_rules.hpp"
#include "workflows/premises/premises_segments.hpp"

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
  std::vector<ReachedBuilding> buildings;
  for (std::size_t i = 0; i < feet.size(); ++i) buildings.push_back({i, box_about(request, feet[i]), {}});
  std::vector<std::vector<HighestAntenna>> antennas(feet.size());
  if (feet.empty()) return antennas;
  const auto segments = premises_segments(store, request, {}, std::move(buildings), progress);
  for_each_segment(
      segments, effort_of_premises, progress, [&](const PremisesSegment& segment, SegmentProgress& of_segment) {
        Statistics statistics;
        SurfaceReader reader(store, Detail::tolerance(0), statistics);
        const PlacedSurface surface(reader.triangles(segment.surface, request.themes, of_segment.reading(0.6)),
                                    progress);
        const PlacedSurface ground(reader.triangles(segment.ground, ThemeChoice::none(), of_segment.reading()),
                                   progress);
        for_each_step(segment.buildings.size(), "places of antennas", of_segment.judging(), [&](std::size_t i) {
          const std::size_t foot = segment.buildings[i].foot;
          const MountRules rules = mount_rules(request, store.metadata(), feet[foot]);
          antennas[foot] = highest_of(mount_places(feet[foot], surface, ground, rules, progress), ground, request);
        });
      });
  return antennas;
}

}  // namespace itin::viewshed
