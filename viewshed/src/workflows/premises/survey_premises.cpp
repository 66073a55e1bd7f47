// The survey of premises, from request to result.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <itin/building_outlines.hpp>
#include <itin/call_progress.hpp>
#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/grazing.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>
#include <viewshed/premises.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "run/segments.hpp"
#include "run/surface_reader.hpp"
#include "workflows/premises/building_links.hpp"
#include "workflows/premises/premises_rules.hpp"
#include "workflows/premises/premises_segments.hpp"

namespace itin::viewshed {

namespace {

void require_premises_request(PremisesRequest& request) {
  if (request.masts.places.empty()) throw InputError("`masts`: there is none; give at least one", "masts");
  if (!(request.radius > 0)) throw InputError("`radius`: give more than 0 m", "radius");
  if (!(request.setback.value_or(1) > 0))
    throw InputError("`setback`: give more than 0 m: the street lies before the walls", "setback");
  complete_antennas(request, request.frequency_ghz);
  if (!request.frequency_ghz) return;
  if (!(*request.frequency_ghz > 0)) throw InputError("`frequency_ghz`: give more than 0 GHz", "frequency_ghz");
  if (!(request.fresnel > 0 && request.fresnel <= 1))
    throw InputError("`fresnel`: give more than 0, and 1 at most", "fresnel");
}

class PremisesSurveyor {
 public:
  PremisesSurveyor(const Store& store, PremisesRequest request, Progress& progress)
      : store_(store), progress_(progress) {
    require_premises_request(request);
    survey_.request = std::move(request);
    survey_.metadata = store.metadata();
    survey_.warnings = survey_.request.masts.warnings;
    require_buildings(survey_.metadata, survey_.request.themes, survey_.warnings);
  }

  PremisesSurvey survey() && {
    progress_.step(0.02);
    place_masts();
    feet_ = building_feet(store_, survey_.request.themes, survey_.metadata.grid.box(survey_.metadata.bounds));
    found_.resize(feet_.size());
    const auto segments = premises_segments(store_, survey_.request, survey_.masts, reached_buildings(), progress_);
    for_each_segment(segments, effort_of_premises, progress_.step(0.97),
                     [&](const PremisesSegment& segment, SegmentProgress& of_segment) { survey(segment, of_segment); });
    name_blockers();
    collect();
    progress_.finish();
    return std::move(survey_);
  }

 private:
  void place_masts() {
    const PremisesRequest& request = survey_.request;
    std::vector<Point2> positions;
    for (const SitePlace& mast : request.masts.places) positions.push_back(mast.position);
    const auto bare = ground_under(store_, positions, ThemeChoice::none(), progress_);
    const auto top = ground_under(store_, positions, request.themes, progress_);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const SitePlace& mast = request.masts.places[i];
      if (!bare[i] || !top[i]) refuse(mast, "there is no data there; move it onto the data");
      const SitePosition place{mast.name, mast.position, mast.height.value_or(request.mast_height),
                               request.masts_on_surface ? *top[i] : *bare[i]};
      if (place.height < 0) refuse(mast, "its height is negative");
      if (place.height == 0 && request.frequency_ghz)
        refuse(mast, "its height is 0, where no Fresnel zone is clear; give it more");
      if (place.elevation() < *top[i] - kGrazing)
        refuse(mast, fmt::format("it ends {:.2f} m below the top of what stands there, and sees nothing; make it "
                                 "higher, move it, or let it stand on that by `on_surface`",
                                 *top[i] - place.elevation()));
      survey_.masts.push_back(place);
    }
  }

  [[noreturn]] static void refuse(const SitePlace& mast, const std::string& why) {
    throw InputError(fmt::format("mast {} at {:.10g},{:.10g}: {}", mast.name, mast.position.x, mast.position.y, why),
                     "masts");
  }

  /// Finds the buildings within the radius of a mast. Throws InputError where there are none.
  std::vector<ReachedBuilding> reached_buildings() const {
    const PremisesRequest& request = survey_.request;
    std::vector<ReachedBuilding> reached;
    double nearest = kInfinity;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      progress_.throw_if_cancelled();
      ReachedBuilding building{i, box_about(request, feet_[i]), {}};
      for (std::size_t m = 0; m < survey_.masts.size(); ++m) {
        const double squared = squared_distance(survey_.masts[m].position, building.box);
        nearest = std::min(nearest, squared);
        if (squared <= request.radius * request.radius) building.masts.push_back(m);
      }
      if (!building.masts.empty()) reached.push_back(std::move(building));
    }
    if (reached.empty())
      throw InputError(fmt::format("no building is within the `radius` of {:g} m of a mast; the nearest is {:.0f} m "
                                   "away; give a greater `radius`, or move the masts",
                                   request.radius, std::sqrt(nearest)),
                       "radius");
    return reached;
  }

  void survey(const PremisesSegment& segment, SegmentProgress& progress) {
    SurfaceReader reader(store_, Detail::tolerance(0), survey_.statistics);
    Tin tin = reader.triangles(segment.surface, survey_.request.themes, progress.reading(0.6));
    const PlacedSurface ground(reader.triangles(segment.ground, ThemeChoice::none(), progress.reading()), progress_);
    Stopwatch watch;
    const PlaceScene scene(std::move(tin), judgement(), progress_);
    const std::vector<MastView> views = views_of(segment, scene);
    survey_.statistics.scene_seconds += watch.lap();
    const BuildingSurroundings surroundings{survey_.request, scene, ground, views};
    for_each_step(segment.buildings.size(), "sight lines", progress.judging(), [&](std::size_t i) {
      const auto& [foot, masts] = segment.buildings[i];
      const MountRules rules = mount_rules(survey_.request, survey_.metadata, feet_[foot]);
      survey_building({feet_[foot], rules, masts}, surroundings, progress_, found_[foot]);
    });
    survey_.statistics.lines_seconds += watch.lap();
  }

  /// The views of the segment's masts, by the numbers of all.
  std::vector<MastView> views_of(const PremisesSegment& segment, const PlaceScene& scene) {
    std::vector<std::size_t> masts;
    for (const BuildingLinks& building : segment.buildings)
      masts.insert(masts.end(), building.masts.begin(), building.masts.end());
    sort_unique(masts);
    std::vector<MastView> views(survey_.masts.size());
    parallel_for(masts.size(), [&](std::size_t i) {
      progress_.throw_if_cancelled();
      const SitePosition& mast = survey_.masts[masts[i]];
      views[masts[i]] = {&mast, scene.view_from({mast.position.x, mast.position.y, mast.elevation()})};
    });
    return views;
  }

  LinkJudgement judgement() const {
    const PremisesRequest& request = survey_.request;
    LinkJudgement rules{request.earth, request.nodata, {}};
    if (request.frequency_ghz) rules.fresnel = {wavelength_m(*request.frequency_ghz), request.fresnel};
    return rules;
  }

  /// Finds the features that are in the way, theme by theme.
  void name_blockers() {
    struct Named {
      std::vector<Point2> places;
      std::vector<std::pair<Premises*, LinkBlocker*>> blockers;
    };
    std::map<std::uint16_t, Named> by_theme;
    for (SurveyedBuilding& building : found_) {
      for (std::size_t i = 0; i < building.premises.links.size(); ++i) {
        auto& blocker = building.premises.links[i].blocker;
        if (!blocker || blocker->theme == 0) continue;
        by_theme[blocker->theme].places.push_back(*building.within_blockers[i]);
        by_theme[blocker->theme].blockers.emplace_back(&building.premises, &*blocker);
      }
    }
    for (auto& [theme, named] : by_theme) {
      const auto features = features_at(store_, theme, named.places, progress_);
      for (std::size_t i = 0; i < features.size(); ++i) {
        if (!features[i]) continue;
        auto& [premises, blocker] = named.blockers[i];
        blocker->feature = features[i]->number, blocker->name = title_of(*features[i]);
        blocker->own = theme == premises->theme && blocker->feature == premises->feature;
      }
    }
  }

  /// Collects the buildings that have places, and those beyond reach, with their names.
  void collect() {
    std::size_t without_places = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      Premises& p = found_[i].premises;
      survey_.statistics.lines += found_[i].lines;
      const bool surveyed = p.theme != 0;
      choose_best(p);
      if (!surveyed) p.theme = feet_[i].theme, p.feature = feet_[i].feature, p.foot = std::move(feet_[i].rings);
      if (surveyed && p.walls.empty() && p.roof_places == 0) {
        ++without_places;
      } else {
        survey_.premises.push_back(std::move(p));
      }
    }
    if (without_places > 0)
      survey_.warnings.push_back(fmt::format(
          "{} within reach left out: neither a wall of more than 2.5 m nor a roof stands there, as where an import "
          "could not raise a footprint",
          counted(without_places, "building")));
    name_premises();
  }

  void name_premises() {
    std::map<std::uint16_t, std::vector<Premises*>> by_theme;
    for (Premises& p : survey_.premises) by_theme[p.theme].push_back(&p);
    for (const auto& [theme, premises] : by_theme) {
      std::vector<std::int64_t> numbers;
      for (const Premises* p : premises) numbers.push_back(p->feature);
      const auto features = features_numbered(store_, theme, numbers);
      for (std::size_t i = 0; i < features.size(); ++i)
        if (features[i]) premises[i]->name = features[i]->name, premises[i]->id = features[i]->id;
    }
  }

  const Store& store_;
  CallProgress progress_;
  PremisesSurvey survey_;
  std::vector<BuildingFoot> feet_;
  std::vector<SurveyedBuilding> found_;  ///< one for each foot
};

}  // namespace

PremisesSurvey survey_premises(const Store& store, PremisesRequest request, Progress& progress) {
  return PremisesSurveyor(store, std::move(request), progress).survey();
}

std::size_t Premises::masts_serving() const {
  return static_cast<std::size_t>(std::count_if(
      links.begin(), links.end(), [](const PremisesLink& link) { return link.verdict == Verdict::kVisible; }));
}

Verdict Premises::verdict() const {
  if (best) return Verdict::kVisible;
  const PremisesLink* miss = nearest_miss();
  return miss == nullptr ? Verdict::kOutside : miss->verdict;
}

const PremisesLink* Premises::nearest_miss() const {
  const auto rank = [](const PremisesLink& link) {
    return std::pair(link.verdict != Verdict::kUndecided, link.tried ? link.tried->distance_m : kInfinity);
  };
  const auto least = std::min_element(links.begin(), links.end(),
                                      [&](const PremisesLink& a, const PremisesLink& b) { return rank(a) < rank(b); });
  return best || least == links.end() ? nullptr : &*least;
}

PremisesCounts PremisesSurvey::counts() const {
  PremisesCounts counts{.all = premises.size()};
  for (const Premises& p : premises) {
    const Verdict verdict = p.verdict();
    if (verdict == Verdict::kVisible) {
      ++(p.best_mounting().on == MountedOn::kWall ? counts.on_walls : counts.on_roofs);
    } else if (verdict == Verdict::kOutside) {
      ++counts.out_of_reach;
    } else {
      ++(verdict == Verdict::kUndecided ? counts.undecided : counts.unserved);
    }
  }
  return counts;
}

}  // namespace itin::viewshed
