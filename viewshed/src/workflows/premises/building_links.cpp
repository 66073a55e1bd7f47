#include "workflows/premises/building_links.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "places/street_sight.hpp"

namespace itin::viewshed {

namespace {

/// A place with all heights that an antenna may have there, ascending.
struct Mount {
  MountedOn on = MountedOn::kWall;
  Point2 position;
  double base_m = 0;
  std::vector<double> heights;
  std::size_t place = 0;  ///< which of the building's walls, or of the places on its roof
};

/// Whether a place is served, and from which of its heights on; otherwise the verdict at the greatest.
struct MountVerdict {
  Verdict verdict = Verdict::kHidden;
  std::size_t height = 0;
};

/// One mast's links to the places of a building. To raise an antenna never hides it: a place whose greatest height is
/// not served is not served at all.
class MastLinks {
 public:
  MastLinks(const BuildingSurroundings& surroundings, const MastView& mast, const std::vector<Mount>& mounts,
            const Progress& progress)
      : scene_(surroundings.scene), mast_(mast), mounts_(mounts), progress_(progress), verdicts_(mounts.size()) {
    for (std::size_t i = 0; i < mounts.size(); ++i)
      if (distance(i) <= surroundings.request.radius) within_.push_back(i);
  }

  bool reaches_any() const { return !within_.empty(); }
  double distance(std::size_t mount) const {
    const Point2 p = mounts_[mount].position, m = mast_.mast->position;
    return std::hypot(p.x - m.x, p.y - m.y);
  }

  /// Finds the least height of every place within reach. Returns how many lines that took. Throws Cancelled.
  std::uint64_t judge() {
    std::vector<std::size_t> open;
    ask(within_, [&](std::size_t i) { return mounts_[i].heights.size() - 1; });
    for (const std::size_t i : within_)
      if (verdicts_[i].verdict == Verdict::kVisible) open.push_back(i);
    for (std::size_t height = 0; !open.empty(); ++height) {
      std::erase_if(open, [&](std::size_t i) { return height + 1 >= mounts_[i].heights.size(); });
      ask(open, [&](std::size_t) { return height; });
      std::erase_if(open, [&](std::size_t i) { return verdicts_[i].height == height; });
    }
    return lines_;
  }

  /// Calls visit(mount, its verdict) for all places within reach.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const std::size_t i : within_) visit(i, verdicts_[i]);
  }

  Mounting mounting(std::size_t mount, std::size_t height) const {
    const Mount& m = mounts_[mount];
    return {m.on, m.position, m.base_m, m.heights[height], distance(mount)};
  }

 private:
  /// Judges the places at the height that height_of(place) numbers; the greatest comes first.
  template <class HeightOf>
  void ask(const std::vector<std::size_t>& places, const HeightOf& height_of) {
    std::vector<Point3> ends;
    for (const std::size_t place : places) {
      const Mount& m = mounts_[place];
      ends.push_back({m.position.x, m.position.y, m.base_m + m.heights[height_of(place)]});
    }
    const std::vector<Verdict> found = scene_.judge_all(mast_.view, ends, progress_);
    for (std::size_t k = 0; k < places.size(); ++k) note(places[k], {found[k], height_of(places[k])});
    lines_ += places.size();
  }

  void note(std::size_t place, const MountVerdict& found) {
    const bool greatest = found.height + 1 == mounts_[place].heights.size();
    if (greatest || found.verdict == Verdict::kVisible) verdicts_[place] = found;
  }

  const PlaceScene& scene_;
  const MastView& mast_;
  const std::vector<Mount>& mounts_;
  const Progress& progress_;
  std::vector<MountVerdict> verdicts_;
  std::vector<std::size_t> within_;  ///< places within the radius
  std::uint64_t lines_ = 0;
};

/// Keeps the mounting with the least rank; of several the first.
template <class Rank>
void keep_least(std::optional<Mounting>& kept, const Mounting& mounting, const Rank& rank) {
  if (!kept || rank(mounting) < rank(*kept)) kept = mounting;
}

class BuildingSurvey {
 public:
  BuildingSurvey(const BuildingFoot& foot, const BuildingSurroundings& surroundings, const Progress& progress,
                 SurveyedBuilding& found)
      : foot_(foot), surroundings_(surroundings), progress_(progress), found_(found) {}

  void take(MountPlaces places) {
    const PremisesRequest& request = surroundings_.request;
    Premises& p = found_.premises;
    for (std::size_t i = 0; i < places.walls.size(); ++i) {
      const WallPlace& wall = places.walls[i];
      mounts_.push_back({MountedOn::kWall, wall.position, wall.ground_m, mount_heights(wall, request.storey), i});
    }
    for (std::size_t i = 0; i < places.roof.size(); ++i)
      mounts_.push_back({MountedOn::kRoof, places.roof[i].position, places.roof[i].roof_m, request.poles, i});
    if (p.theme != 0) return;  // it was surveyed for other masts
    p.roof_places = places.roof.size();
    if (request.setback) look_at_street(places), p.roof = std::move(places.roof);
    p.walls = std::move(places.walls);
    p.theme = foot_.theme, p.feature = foot_.feature, p.foot = foot_.rings;
  }

  void add(std::size_t number) {
    const MastView& mast = surroundings_.views[number];
    MastLinks links(surroundings_, mast, mounts_, progress_);
    if (!links.reaches_any()) return;
    found_.lines += links.judge();
    PremisesLink link;
    link.mast = number;
    links.for_each([&](std::size_t i, const MountVerdict& found) {
      if (found.verdict != Verdict::kVisible) return;
      const Mounting mounting = links.mounting(i, found.height);
      keep_least(mounting.on == MountedOn::kWall ? link.wall : link.roof, mounting,
                 [](const Mounting& m) { return std::pair(m.height_m, m.distance_m); });
      if (mounting.on == MountedOn::kWall) {
        serve(found_.premises.walls[mounts_[i].place], mounting, number);
      } else if (!found_.premises.roof.empty()) {
        serve(found_.premises.roof[mounts_[i].place], mounting, number);
      }
    });
    note_undecided(links);
    std::optional<Point2> within_blocker;
    if (link.wall || link.roof) {
      link.verdict = Verdict::kVisible;
    } else {
      within_blocker = explain(links, mast, link);
    }
    found_.premises.links.push_back(std::move(link));
    found_.within_blockers.push_back(within_blocker);
  }

 private:
  void look_at_street(MountPlaces& places) const {
    for (RoofPlace& place : places.roof) {
      progress_.throw_if_cancelled();
      place.street = street_sight(surroundings_.scene.surface(), surroundings_.request.earth, places.street, place);
    }
  }

  /// Lets the mast serve a place where no other does so from a lower height, or from as low and nearer.
  template <class Place>
  static void serve(Place& place, const Mounting& mounting, std::size_t mast) {
    const auto rank = std::pair(mounting.height_m, mounting.distance_m);
    if (place.mast && std::pair(place.height_m, place.distance_m) <= rank) return;
    place.mast = mast;
    std::tie(place.height_m, place.distance_m) = rank;
  }

  void note_undecided(const MastLinks& links) {
    links.for_each([&](std::size_t i, const MountVerdict& found) {
      if (mounts_[i].on == MountedOn::kWall && found.verdict == Verdict::kUndecided)
        found_.premises.walls[mounts_[i].place].undecided = true;
    });
  }

  /// Tells of a link that serves no place where it was tried, and what is in the way. Returns a place within that.
  std::optional<Point2> explain(const MastLinks& links, const MastView& mast, PremisesLink& link) const {
    const bool open = any_undecided(links);
    links.for_each([&](std::size_t i, const MountVerdict& found) {
      if (open && found.verdict != Verdict::kUndecided) return;
      const Mounting mounting = links.mounting(i, found.height);
      const auto rank = [](const Mounting& m) { return std::pair(-m.elevation_m(), m.distance_m); };
      if (link.tried && !(rank(mounting) < rank(*link.tried))) return;
      link.tried = mounting, link.verdict = found.verdict;
    });
    if (open) return std::nullopt;
    const Mounting& tried = *link.tried;
    const auto obstacle =
        surroundings_.scene.obstacle(mast.view, {tried.position.x, tried.position.y, tried.elevation_m()});
    if (!obstacle) return std::nullopt;
    link.blocker = LinkBlocker{.theme = obstacle->theme, .name = {}, .position = obstacle->position};
    return obstacle->within;
  }

  static bool any_undecided(const MastLinks& links) {
    bool any = false;
    links.for_each([&](std::size_t, const MountVerdict& found) { any = any || found.verdict == Verdict::kUndecided; });
    return any;
  }

  const BuildingFoot& foot_;
  const BuildingSurroundings& surroundings_;
  const Progress& progress_;
  SurveyedBuilding& found_;
  std::vector<Mount> mounts_;
};

}  // namespace

void survey_building(const BuildingToSurvey& building, const BuildingSurroundings& surroundings,
                     const Progress& progress, SurveyedBuilding& found) {
  const auto& [foot, rules, masts] = building;
  BuildingSurvey survey(foot, surroundings, progress, found);
  survey.take(mount_places({foot, surroundings.scene.surface(), surroundings.ground, rules}, progress));
  for (const std::size_t mast : masts) survey.add(mast);
}

void choose_best(Premises& p) {
  const auto rank = [&](std::size_t i) {
    const PremisesLink& link = p.links[i];
    const Mounting& m = link.wall ? *link.wall : *link.roof;
    return std::tuple(m.on, m.height_m, m.distance_m);
  };
  for (std::size_t i = 0; i < p.links.size(); ++i)
    if (p.links[i].verdict == Verdict::kVisible && (!p.best || rank(i) < rank(*p.best))) p.best = i;
  for (WallPlace& wall : p.walls) wall.undecided = wall.undecided && !wall.mast;
}

}  // namespace itin::viewshed
