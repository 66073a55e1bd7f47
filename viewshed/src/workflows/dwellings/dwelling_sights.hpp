// What the eyes of dwellings see of turbines over a surface in memory.
//
//   const TurbineEnds ends = turbine_ends(scene, survey, turbine);
//   const std::vector<TurbineSight> sights = look_at_turbine(scene, survey, ends, dwelling.facades, progress);
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/dwellings.hpp>

#include "places/place_scene.hpp"

namespace itin::viewshed {

/// A turbine's tip and hub, with the lines that end there.
struct TurbineEnds {
  std::size_t turbine = 0;  ///< its index in the survey's request
  PlaceScene::View tip;
  std::optional<PlaceScene::View> hub;  ///< nothing where its height is not known
};
TurbineEnds turbine_ends(const PlaceScene& scene, const DwellingsSurvey& survey, std::size_t turbine);

/// Where the facade looks from, metres.
Point3 eye_of_facade(const DwellingsSurvey& survey, const DwellingFacade& facade);

/// Tells whether a place is before the facade; any is before an eye in the open.
bool is_before(const DwellingFacade& facade, Point2 place);

/// Finds what each of the facades sees of the turbine. Both ends of a line keep their bare ground whatever the surface;
/// `itin los` gives the same verdicts. A turbine behind a facade is Verdict::kOutside. Throws Cancelled.
std::vector<TurbineSight> look_at_turbine(const PlaceScene& scene, const DwellingsSurvey& survey,
                                          const TurbineEnds& ends, std::span<const DwellingFacade> facades,
                                          const Progress& progress);

}  // namespace itin::viewshed
