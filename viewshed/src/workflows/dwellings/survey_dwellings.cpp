// The survey of dwellings, from request to result.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/building_outlines.hpp>
#include <itin/call_progress.hpp>
#include <itin/celestial_body.hpp>
#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/geodesic.hpp>
#include <viewshed/dwellings.hpp>

#include "line/infinity.hpp"
#include "places/place_scene.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"
#include "turbines/sun_behind_rotor.hpp"
#include "workflows/dwellings/choose_dwellings.hpp"
#include "workflows/dwellings/dwelling_facades.hpp"
#include "workflows/dwellings/dwelling_segments.hpp"
#include "workflows/dwellings/dwelling_sights.hpp"
#include "workflows/dwellings/flicker_runs.hpp"
#include "workflows/dwellings/sights_in_season.hpp"
#include "workflows/dwellings/sun_reach.hpp"
#include "workflows/premises/each_building.hpp"
#include "workflows/premises/premises_rules.hpp"
#include "workflows/zone/study_document.hpp"

namespace itin::viewshed {

namespace {

void require_dwellings_request(const DwellingsRequest& request) {
  const auto require = [](bool right, const char* field, const std::string& what) {
    if (!right) throw InputError(fmt::format("`{}`: {}", field, what), field);
  };
  const FlickerRules& rules = request.flicker;
  require(!request.turbines.turbines.empty(), "turbines", "there is none; give at least one");
  require(request.radius > 0, "radius", "give more than 0 m");
  require(request.eye_height >= 0, "eye_height", "give 0 m or more");
  require(rules.year.year >= kFirstYearOfSun && rules.year.year <= kLastYearOfSun, "year",
          fmt::format("the sun's place is known from {} to {}", kFirstYearOfSun, kLastYearOfSun));
  require(std::abs(rules.year.utc_offset_minutes) <= 14 * 60, "utc_offset_minutes",
          "no clock is more than 14 hours from universal time");
  require(rules.least_elevation_deg >= 1 && rules.least_elevation_deg < 90, "least_elevation_deg",
          "give 1 degree or more, and less than 90");
  require(rules.reach_diameters > 0, "reach_diameters", "give more than 0");
  require(!rules.blade_width || *rules.blade_width > 0, "blade_width", "give more than 0 m");
}

/// The box about the far ends of lines of this length from a place, up to so much to either side of a direction.
Box box_of_ends(Point2 from, Point2 towards, double half_angle, double length) {
  if (half_angle >= std::numbers::pi / 4) return square_about(from, length);
  const double middle = std::atan2(towards.y - from.y, towards.x - from.x);
  Box box;
  // The corners of the wedge whose far side touches the arc.
  for (const double side : {-1.0, 1.0})
    for (const double far : {length, length / std::cos(half_angle)})
      box.extend(Point2{from.x + far * std::cos(middle + side * half_angle),
                        from.y + far * std::sin(middle + side * half_angle)});
  return box;
}

class DwellingsSurveyor {
 public:
  DwellingsSurveyor(const Store& store, DwellingsRequest request, Progress& progress)
      : store_(store), progress_(progress), body_(body_of(store.metadata().crs_wkt)) {
    require_dwellings_request(request);
    if (!body_.is_earth)
      throw InputError("`year`: the store is not of the Earth, and how the sun moves there is not known", "year");
    survey_.request = std::move(request);
    survey_.metadata = store.metadata();
    survey_.warnings = survey_.request.turbines.warnings;
    for (const BadRow& bad : survey_.request.turbines.bad)
      survey_.warnings.push_back(bad_row_warning(survey_.request.turbines.path, bad));
    const auto& more = survey_.request.dwellings.warnings;
    survey_.warnings.insert(survey_.warnings.end(), more.begin(), more.end());
    premises_.themes = survey_.request.themes, premises_.memory_bytes = survey_.request.memory_bytes;
    if (survey_.request.foliage) seasons_.emplace(store, survey_);
    if (!has_screens()) seasons_.reset();
  }

  DwellingsSurvey survey() && {
    progress_.step(0.05);
    place_turbines();
    choose();
    find_facades();
    name_dwellings();
    year_.emplace(survey_.request.flicker.year, progress_);
    look_at_skies();
    progress_.step(0.1);
    const auto segments = dwelling_segments(store_, survey_.request, all_pairs(), progress_);
    for_each_segment(segments, effort_of_dwellings, progress_.step(1),
                     [&](const DwellingSegment& segment, SegmentProgress& of_segment) { judge(segment, of_segment); });
    order_flicker();
    progress_.finish();
    return std::move(survey_);
  }

 private:
  const std::vector<Turbine>& turbines() const { return survey_.request.turbines.turbines; }

  void place_turbines() {
    std::vector<Point2> positions;
    for (const Turbine& t : turbines()) positions.push_back(t.position);
    const auto ground = ground_under(store_, positions, ThemeChoice::none(), progress_);
    std::vector<Turbine> placed;
    std::size_t without_rotor = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Turbine& turbine = turbines()[i];
      if (!ground[i]) {
        survey_.warnings.push_back(fmt::format("turbine {} at {:.10g},{:.10g} is left out: there is no data there",
                                               turbine.number, turbine.position.x, turbine.position.y));
        continue;
      }
      without_rotor += shadow_reach(survey_.request.flicker, turbine) > 0 ? 0 : 1;
      placed.push_back(turbine), survey_.ground_m.push_back(*ground[i]);
    }
    if (placed.empty()) throw InputError("`turbines`: there is no data under any of them", "turbines");
    if (without_rotor > 0)
      survey_.warnings.push_back(fmt::format("{} without hub height or rotor diameter: no flicker is known of {}",
                                             counted(without_rotor, "turbine"), without_rotor == 1 ? "it" : "them"));
    survey_.request.turbines.turbines = std::move(placed);
  }

  void choose() {
    const Box all = survey_.metadata.grid.box(survey_.metadata.bounds);
    const auto feet = building_feet(store_, survey_.request.themes, all);
    const std::size_t given = survey_.request.dwellings.places.size();
    if (given == 0) warn_of_left_out(survey_.metadata, survey_.request.themes, survey_.warnings);
    survey_.dwellings = choose_dwellings(survey_.request, survey_.metadata, feet, progress_);
    if (given > survey_.dwellings.size())
      survey_.warnings.push_back(fmt::format(
          "{} of {} not studied: farther than {:g} m from all turbines, and beyond the reach of their shadows",
          given - survey_.dwellings.size(), counted(given, "dwelling"), survey_.request.radius));
  }

  // Where their eyes are.

  void find_facades() {
    find_walls();
    find_open_ground();
    std::size_t without = 0;
    std::vector<Dwelling> kept;
    for (Dwelling& dwelling : survey_.dwellings) {
      if (dwelling.facades.empty())
        ++without;
      else
        kept.push_back(std::move(dwelling));
    }
    survey_.dwellings = std::move(kept);
    if (without > 0)
      survey_.warnings.push_back(
          fmt::format("{} left out: no wall of more than 2.5 m stands on the ground there, or there is no ground",
                      counted(without, "dwelling")));
    if (survey_.dwellings.empty())
      throw InputError("`dwellings`: none of them has a facade on the ground", "dwellings");
  }

  void find_walls() {
    std::vector<BuildingFoot> feet;
    std::vector<Dwelling*> of_feet;
    for (Dwelling& dwelling : survey_.dwellings)
      if (dwelling.theme != 0)
        feet.push_back({dwelling.theme, dwelling.feature, dwelling.foot}), of_feet.push_back(&dwelling);
    for_each_building(store_, premises_, feet, {"facades", survey_.statistics}, progress_,
                      [&](std::size_t i, const StandingBuilding& building) {
                        of_feet[i]->facades = facades_of(wall_places(building, progress_));
                      });
  }

  void find_open_ground() {
    std::vector<Point2> open;
    for (const Dwelling& dwelling : survey_.dwellings)
      if (dwelling.theme == 0) open.push_back(dwelling.position);
    if (open.empty()) return;
    const auto ground = ground_under(store_, open, ThemeChoice::none(), progress_);
    std::size_t next = 0;
    for (Dwelling& dwelling : survey_.dwellings)
      if (dwelling.theme == 0)
        if (const auto& here = ground[next++]) dwelling.facades = {{dwelling.position, *here}};
  }

  void name_dwellings() {
    std::map<std::uint16_t, std::vector<Dwelling*>> by_theme;
    for (Dwelling& dwelling : survey_.dwellings)
      if (dwelling.theme != 0) by_theme[dwelling.theme].push_back(&dwelling);
    for (const auto& [theme, dwellings] : by_theme) {
      std::vector<std::int64_t> numbers;
      for (const Dwelling* dwelling : dwellings) numbers.push_back(dwelling->feature);
      const auto features = features_numbered(store_, theme, numbers);
      for (std::size_t i = 0; i < features.size(); ++i) {
        if (!features[i]) continue;
        if (dwellings[i]->name.empty()) dwellings[i]->name = features[i]->name;
        dwellings[i]->id = features[i]->id;
      }
    }
  }

  // Where the sun is.

  /// Finds for each dwelling where the sun goes, and how the grid lies there.
  void look_at_skies() {
    const CoordinateTransform to_geographic(survey_.metadata.crs_wkt, body_.geographic_crs);
    constexpr double kNorthward = 100;
    for (const Dwelling& dwelling : survey_.dwellings) {
      const Point2 here = to_geographic(dwelling.position);
      const Point2 north = to_geographic({dwelling.position.x, dwelling.position.y + kNorthward});
      skies_.push_back({SkyAt(here, dwelling.facades.front().ground_m),
                        in_radians(geodesic(here, north, body_.ellipsoid).azimuth_deg)});
    }
    require_sun();
  }

  void require_sun() const {
    const FlickerRules& rules = survey_.request.flicker;
    const double least = std::sin(in_radians(rules.least_elevation_deg));
    constexpr std::uint32_t kEvery = 10;
    for (std::uint32_t m = 0; m < year_->days() * SunYear::kMinutesOfDay; m += kEvery)
      if (skies_.front().sky.apparent(year_->direction(m)).z >= least) return;
    throw InputError(
        fmt::format("`least_elevation_deg`: the sun does not rise {:g} degrees high there in {}; give less",
                    rules.least_elevation_deg, rules.year.year),
        "least_elevation_deg");
  }

  /// The pairs of dwellings and turbines, with the ground that each needs.
  std::vector<DwellingPair> all_pairs() {
    std::vector<DwellingPair> pairs;
    EyesInSun eyes{{}, kInfinity, survey_.request.flicker.least_elevation_deg};
    for (std::size_t d = 0; d < survey_.dwellings.size(); ++d) {
      for (DwellingFacade& facade : survey_.dwellings[d].facades) {
        eyes.box.extend(facade.position);
        eyes.lowest_m = std::min(eyes.lowest_m, facade.ground_m + survey_.request.eye_height);
        facade.bare.resize(turbines().size());
        if (has_screens()) facade.screened.resize(turbines().size());
        if (seasons_) facade.summer.resize(turbines().size()), facade.winter.resize(turbines().size());
      }
      for (std::size_t t = 0; t < turbines().size(); ++t) {
        const bool in_shadow = may_shade(survey_.request.flicker, turbines()[t], survey_.dwellings[d].position);
        pairs.push_back({d, t, in_shadow, {}, {}});
      }
    }
    reach_ = sun_reach(store_, survey_.request.themes, survey_.request.earth, eyes, progress_);
    for (DwellingPair& pair : pairs) add_boxes(pair);
    return pairs;
  }

  bool has_screens() const { return survey_.request.themes.includes_raised(survey_.metadata.themes); }

  void add_boxes(DwellingPair& pair) const {
    const Turbine& turbine = turbines()[pair.turbine];
    pair.ends.extend(turbine.position);
    for (const DwellingFacade& facade : survey_.dwellings[pair.dwelling].facades) {
      pair.eyes.extend(facade.position);
      if (!pair.in_shadow) continue;
      const double radius = *turbine.rotor_diameter / 2;
      const double sine = radius / std::max(distance(facade.position, turbine.position), radius);
      pair.ends.extend(box_of_ends(facade.position, turbine.position, std::asin(sine), farthest(facade)));
    }
  }

  /// How far lines to the sun go over what may hide it: a metre at least.
  double farthest(const DwellingFacade& facade) const {
    const double rise = reach_.top_m - facade.ground_m - survey_.request.eye_height;
    return std::clamp(rise / std::tan(in_radians(survey_.request.flicker.least_elevation_deg)), 1.0,
                      std::max(1.0, reach_.metres));
  }

  // What is seen, and when it flickers.

  void judge(const DwellingSegment& segment, SegmentProgress& progress) {
    SurfaceReader reader(store_, Detail::tolerance(0), survey_.statistics);
    const LinkJudgement rules{survey_.request.earth, survey_.request.nodata, {}};
    Tin surface = reader.triangles(segment.surface, survey_.request.themes, progress.reading(has_screens() ? 0.6 : 1));
    Tin ground, without_woods;
    if (seasons_)
      without_woods =
          reader.triangles(segment.surface, survey_.request.themes.without_vegetation(), progress.reading(0.5));
    if (has_screens()) ground = reader.triangles(segment.surface, ThemeChoice::none(), progress.reading());
    CallProgress judging(progress.judging());
    if (seasons_) {
      const PlaceScene scene(std::move(without_woods), rules, progress_);
      find_sights(segment, scene, &DwellingFacade::winter, judging.step(0.2));
    }
    {
      const PlaceScene scene(std::move(surface), rules, progress_);
      find_flicker(segment, scene, judging.step(0.6));
      find_sights(segment, scene, has_screens() ? &DwellingFacade::screened : &DwellingFacade::bare, judging.step(0.5));
      if (seasons_) find_seasons(segment, scene.surface().tin, judging.step(0.5));
    }
    if (!has_screens()) return;
    const PlaceScene scene(std::move(ground), rules, progress_);
    find_sights(segment, scene, &DwellingFacade::bare, judging.step(1));
  }

  void find_sights(const DwellingSegment& segment, const PlaceScene& scene,
                   std::vector<TurbineSight> DwellingFacade::*sights, Progress& progress) {
    Stopwatch watch;
    std::map<std::size_t, TurbineEnds> ends;
    for (const DwellingPair& pair : segment.pairs) {
      progress_.throw_if_cancelled();
      if (!ends.contains(pair.turbine)) ends.emplace(pair.turbine, turbine_ends(scene, survey_, pair.turbine));
      survey_.statistics.lines += survey_.dwellings[pair.dwelling].facades.size() * 2;
    }
    for_each_step(segment.pairs.size(), "sight lines", progress, [&](std::size_t i) {
      const DwellingPair& pair = segment.pairs[i];
      auto& facades = survey_.dwellings[pair.dwelling].facades;
      const auto seen = look_at_turbine(scene, survey_, ends.at(pair.turbine), facades, progress_);
      for (std::size_t f = 0; f < facades.size(); ++f) (facades[f].*sights)[pair.turbine] = seen[f];
    });
    survey_.statistics.lines_seconds += watch.lap();
  }

  void find_seasons(const DwellingSegment& segment, const Tin& surface, Progress& progress) {
    Stopwatch watch;
    std::map<std::size_t, std::vector<std::size_t>> turbines_of;
    for (const DwellingPair& pair : segment.pairs) turbines_of[pair.dwelling].push_back(pair.turbine);
    std::vector<std::size_t> seen_from;
    for (const auto& [dwelling, turbines] : turbines_of) seen_from.push_back(dwelling);
    for_each_step(seen_from.size(), "looking through foliage", progress, [&](std::size_t i) {
      for (DwellingFacade& facade : survey_.dwellings[seen_from[i]].facades)
        seasons_->look(surface, turbines_of.at(seen_from[i]), facade, progress_);
    });
    survey_.statistics.lines_seconds += watch.lap();
  }

  void find_flicker(const DwellingSegment& segment, const PlaceScene& scene, Progress& progress) {
    Stopwatch watch;
    std::vector<DwellingPair> pairs;
    std::copy_if(segment.pairs.begin(), segment.pairs.end(), std::back_inserter(pairs),
                 [](const DwellingPair& pair) { return pair.in_shadow; });
    std::vector<std::vector<TurbineFlicker>> found(pairs.size());  // by facade
    std::vector<std::uint64_t> lines(pairs.size());
    for_each_step(pairs.size(), "shadow flicker", progress, [&](std::size_t i) {
      for (const DwellingFacade& facade : survey_.dwellings[pairs[i].dwelling].facades)
        found[i].push_back({pairs[i].turbine, lit_runs(scene, pairs[i], facade, lines[i])});
    });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      survey_.statistics.lines += lines[i];
      auto& facades = survey_.dwellings[pairs[i].dwelling].facades;
      for (std::size_t f = 0; f < facades.size(); ++f)
        if (!found[i][f].runs.empty()) facades[f].flicker.push_back(std::move(found[i][f]));
    }
    survey_.statistics.lines_seconds += watch.lap();
  }

  std::vector<FlickerRun> lit_runs(const PlaceScene& scene, const DwellingPair& pair, const DwellingFacade& facade,
                                   std::uint64_t& lines) const {
    const Turbine& turbine = turbines()[pair.turbine];
    const Earth& earth = survey_.request.earth;
    const Point3 eye = eye_of_facade(survey_, facade);
    const double drop = earth.drop(distance(facade.position, turbine.position));
    const SeenRotor rotor{{turbine.position.x - eye.x, turbine.position.y - eye.y,
                           survey_.ground_m[pair.turbine] + *turbine.hub_height - drop - eye.z},
                          *turbine.rotor_diameter / 2};
    SunEye sun = skies_[pair.dwelling];
    sun.outward_deg = facade.outward_deg;
    const auto minutes = sun_behind(*year_, sun, rotor, survey_.request.flicker.least_elevation_deg);
    lines += minutes.size();
    if (minutes.empty()) return {};
    const double length = farthest(facade);
    std::vector<Point3> ends;
    for (const SunMinute& minute : minutes) ends.push_back(end_of_ray(eye, minute.direction, length));
    const std::vector<Verdict> verdicts = scene.judge_all(scene.view_past_voids(eye), ends, progress_);
    std::vector<FlickerRun> lit;
    for (std::size_t i = 0; i < minutes.size(); ++i)
      if (verdicts[i] != Verdict::kHidden) lit.push_back({minutes[i].minute, 1});
    return joined_runs(lit);
  }

  /// Where the ray to the sun is at a horizontal distance.
  Point3 end_of_ray(const Point3& eye, const Point3& direction, double length) const {
    constexpr double kUpright = 1e-6;
    const double level = std::max(kUpright, std::hypot(direction.x, direction.y));
    return {eye.x + length * direction.x / level, eye.y + length * direction.y / level,
            eye.z + length * direction.z / level + survey_.request.earth.drop(length)};
  }

  /// Puts turbines in their order, whatever the segments' was.
  void order_flicker() {
    for (Dwelling& dwelling : survey_.dwellings)
      for (DwellingFacade& facade : dwelling.facades)
        std::sort(facade.flicker.begin(), facade.flicker.end(),
                  [](const TurbineFlicker& a, const TurbineFlicker& b) { return a.turbine < b.turbine; });
  }

  const Store& store_;
  CallProgress progress_;
  const CelestialBody body_;
  DwellingsSurvey survey_;
  PremisesRequest premises_;   ///< how walls are found
  std::vector<SunEye> skies_;  ///< one for each dwelling
  std::optional<SunYear> year_;
  std::optional<SightsInSeason> seasons_;  ///< where woods are seen through
  SunReach reach_;
};

}  // namespace

DwellingsSurvey survey_dwellings(const Store& store, DwellingsRequest request, Progress& progress) {
  return DwellingsSurveyor(store, std::move(request), progress).survey();
}

}  // namespace itin::viewshed
