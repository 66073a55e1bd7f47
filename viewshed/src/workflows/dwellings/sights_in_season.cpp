#include "workflows/dwellings/sights_in_season.hpp"

#include <numeric>
#include <vector>

#include <itin/silent_progress.hpp>
#include <viewshed/turbine_sights.hpp>

#include "foliage/season_light.hpp"
#include "workflows/dwellings/dwelling_sights.hpp"

namespace itin::viewshed {

/// The lines from one facade to heights on the axes of turbines, in one season.
class SightsInSeason::Look {
 public:
  Look(const DwellingsSurvey& survey, const FoliageLines::FromEye& lines, double leaf_area, Progress& progress)
      : survey_(survey), lines_(lines), leaf_area_(leaf_area), progress_(progress) {}

  /// Turns what is seen past everything but woods into what is seen in the season.
  void look(std::span<const std::size_t> turbines, const DwellingFacade& facade,
            std::vector<TurbineSight>& sights) const {
    for (const std::size_t t : dark(
             turbines, facade.screened, sights, [](const TurbineSight& s) { return s.tip; },
             [](const Turbine& t) { return t.tip_height; }))
      sights[t].tip = Verdict::kHidden, sights[t].visible = sights[t].vertical_deg = 0;
    for (const std::size_t t : dark(
             turbines, facade.screened, sights, [](const TurbineSight& s) { return s.hub.value_or(Verdict::kHidden); },
             [](const Turbine& t) { return t.hub_height.value_or(0); }))
      sights[t].hub = Verdict::kHidden;
    std::vector<HeightRange> ranges;
    for (const std::size_t t : turbines) {
      const double tip = turbine(t).tip_height;
      if (sights[t].tip == Verdict::kVisible)
        ranges.push_back({t, tip - sights[t].visible, tip - facade.screened[t].visible});
    }
    narrow(ranges);
    const double eye_m = eye_of_facade(survey_, facade).z;
    for (const HeightRange& r : ranges)
      tell_angles({survey_.request.earth, survey_.ground_m[r.turbine], turbine(r.turbine).tip_height, eye_m}, r.high,
                  sights[r.turbine]);
  }

 private:
  /// The least height seen of a turbine lies within, and enough light comes from the upper one.
  struct HeightRange {
    std::size_t turbine = 0;
    double low = 0, high = 0;  ///< metres above its ground
    double middle() const { return std::midpoint(low, high); }
  };

  const Turbine& turbine(std::size_t t) const { return survey_.request.turbines.turbines[t]; }

  Point3 above_ground(std::size_t t, double height) const {
    const Point2 at = turbine(t).position;
    return {at.x, at.y, survey_.ground_m[t] + height};
  }

  /// Tells of each end whether enough light comes from it.
  std::vector<bool> light_from(const std::vector<Point3>& ends) const {
    std::vector<bool> comes;
    for (const LightThrough& light : lines_.to(ends, progress_))
      comes.push_back(comes_through(*survey_.request.foliage, leaf_area_, light.length_m));
    return comes;
  }

  /// Returns the turbines whose end is seen past everything but woods, but from which too little light comes.
  template <class VerdictOf, class HeightOf>
  std::vector<std::size_t> dark(std::span<const std::size_t> turbines, const std::vector<TurbineSight>& full,
                                const std::vector<TurbineSight>& past_all, const VerdictOf& verdict_of,
                                const HeightOf& height_of) const {
    std::vector<std::size_t> behind_woods;
    std::vector<Point3> ends;
    for (const std::size_t t : turbines) {
      const Verdict verdict = verdict_of(past_all[t]);
      if (verdict == Verdict::kOutside || verdict == Verdict::kHidden || verdict_of(full[t]) == Verdict::kVisible)
        continue;
      behind_woods.push_back(t), ends.push_back(above_ground(t, height_of(turbine(t))));
    }
    const std::vector<bool> comes = light_from(ends);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < behind_woods.size(); ++i)
      if (!comes[i]) found.push_back(behind_woods[i]);
    return found;
  }

  /// Halves the ranges until each is less than a centimetre.
  void narrow(std::vector<HeightRange>& ranges) const {
    constexpr double kCloseEnough = 0.01;
    std::vector<std::size_t> wide;
    do {
      wide.clear();
      std::vector<Point3> ends;
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (ranges[i].high - ranges[i].low <= kCloseEnough) continue;
        wide.push_back(i), ends.push_back(above_ground(ranges[i].turbine, ranges[i].middle()));
      }
      const std::vector<bool> comes = light_from(ends);
      for (std::size_t i = 0; i < wide.size(); ++i) {
        HeightRange& range = ranges[wide[i]];
        (comes[i] ? range.high : range.low) = range.middle();
      }
    } while (!wide.empty());
  }

  const DwellingsSurvey& survey_;
  const FoliageLines::FromEye& lines_;
  double leaf_area_;
  Progress& progress_;
};

SightsInSeason::SightsInSeason(const Store& store, const DwellingsSurvey& survey)
    : survey_(survey),
      lines_(store, {Detail::tolerance(0), survey.request.themes, survey.request.earth},
             {.extinction = survey.request.foliage->extinction,
              .least_transmittance = survey.request.foliage->least_transmittance}) {}

void SightsInSeason::look(const Tin& surface, std::span<const std::size_t> turbines, DwellingFacade& facade,
                          Progress& progress) const {
  SilentProgress quiet(progress);
  const FoliageLines::FromEye lines = lines_.from(surface, eye_of_facade(survey_, facade));
  for (const std::size_t t : turbines) facade.summer[t] = facade.winter[t];
  Look(survey_, lines, profile::kLeavesOn, quiet).look(turbines, facade, facade.summer);
  Look(survey_, lines, profile::kLeavesOff, quiet).look(turbines, facade, facade.winter);
}

}  // namespace itin::viewshed
