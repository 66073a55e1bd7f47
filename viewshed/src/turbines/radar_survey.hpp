// The least height at which something rises above a radar's horizon.
//
//   RadarSurvey radar(units, ground_m, zone);      // zone.radar has no findings yet
//   radar.run(surface, part, stage);               // for every part
#pragma once

#include <optional>

#include <viewshed/turbines.hpp>

#include "progress/stage.hpp"
#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "scene/exact_scene.hpp"
#include "turbines/zone_parts.hpp"

namespace itin::viewshed {

class RadarSurvey {
 public:
  /// Takes the elevation of the ground under the zone's radar. The zone must outlive the survey. Throws InputError
  /// where there is no such ground.
  RadarSurvey(const Grid& units, std::optional<double> ground_m, Zone& zone);

  /// Enters the least visible heights over the part's radar_tiles, and what the radar sees of its radar_turbines. Every
  /// tile is a step.
  void run(const ExactScene& ground, const ZonePart& part, Stage& stage);

 private:
  struct PartView;
  void survey_tile(const PartView& over, std::size_t tile);
  void survey_turbine(const PartView& over, std::size_t turbine);

  Zone& zone_;
  Eye eye_;
};

}  // namespace itin::viewshed
