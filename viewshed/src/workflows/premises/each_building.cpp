#include "workflows/premises/each_building.hpp"

#include <utility>

#include "progress/stage.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"
#include "workflows/premises/premises_rules.hpp"
#include "workflows/premises/premises_segments.hpp"

namespace itin::viewshed {

void for_each_building(const Store& store, const PremisesRequest& request, const std::vector<BuildingFoot>& feet,
                       const BuildingStage& stage, Progress& progress,
                       const std::function<void(std::size_t, const StandingBuilding&)>& visit) {
  if (feet.empty()) return;
  std::vector<ReachedBuilding> buildings;
  for (std::size_t i = 0; i < feet.size(); ++i) buildings.push_back({i, box_about(request, feet[i]), {}});
  const auto segments = premises_segments(store, request, {}, std::move(buildings), progress);
  SurfaceReader reader(store, Detail::tolerance(0), stage.statistics);
  for_each_segment(segments, effort_of_premises, progress,
                   [&](const PremisesSegment& segment, SegmentProgress& of_segment) {
                     const PlacedSurface surface(
                         reader.triangles(segment.surface, request.themes, of_segment.reading(0.6)), progress);
                     const PlacedSurface ground(
                         reader.triangles(segment.ground, ThemeChoice::none(), of_segment.reading()), progress);
                     for_each_step(segment.buildings.size(), stage.name, of_segment.judging(), [&](std::size_t i) {
                       const std::size_t number = segment.buildings[i].foot;
                       const BuildingFoot& foot = feet[number];
                       visit(number, {foot, surface, ground, mount_rules(request, store.metadata(), foot)});
                     });
                   });
}

}  // namespace itin::viewshed
