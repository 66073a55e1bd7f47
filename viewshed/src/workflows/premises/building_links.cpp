#include "workflows/premises/building_links.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace itin::viewshed {

namespace {

/// A place with all heights that an antenna may have there, ascending.
struct Mount {
  MountedOn on = MountedOn::kWall;
  Point2 position;
  double base_m = 0;
  std::vector<double> heights;
  std::size_t wall = 0;  ///< which of the building's, for a place on one
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
  MastLinks(const PlaceScene& scene, const MastView& mast, const std::vector<Mount>& mounts, double radius)
      : scene_(scene), mast_(mast), mounts_(mounts), verdicts_(mounts.size()) {
    for (std::size_t i = 0; i < mounts.size(); ++i)
      if (distance(i) <= radius) within_.push_back(i);
  }

  bool reaches_any() const { return !within_.empty(); }
  double distance(std::size_t mount) const {
    const Point2 p = mounts_[mount].position, m = mast_.mast->position;
    return std::hypot(p.x - m.x, p.y - m.y);
  }

  /// Finds the least height of every place within reach. Returns how many lines that took.
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
    for (std::size_t first = 0; first < places.size(); first += PlaceScene::kAtOnce) {
      const auto some = std::span(places).subspan(first, std::min(PlaceScene::kAtOnce, places.size() - first));
      std::array<Point3, PlaceScene::kAtOnce> ends;
      for (std::size_t k = 0; k < some.size(); ++k) {
        const Mount& m = mounts_[some[k]];
        ends[k] = {m.position.x, m.position.y, m.base_m + m.heights[height_of(some[k])]};
      }
      const PlaceScene::Verdicts found = scene_.judge(mast_.view, std::span(ends).first(some.size()));
      for (std::size_t k = 0; k < some.size(); ++k) note(some[k], {found[k], height_of(some[k])});
      lines_ += some.size();
    }
  }

  void note(std::size_t place, const MountVerdict& found) {
    const bool greatest = found.height + 1 == mounts_[place].heights.size();
    if (greatest || found.verdict == Verdict::kVisible) verdicts_[place] = found;
  }

  const PlaceScene& scene_;
  const MastView& mast_;
  const std::vector<Mount>& mounts_;
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
  BuildingSurvey(const BuildingFoot& foot, const PremisesRequest& request, const PlaceScene& scene, MountPlaces places)
      : request_(request), scene_(scene) {
    Premises& p = found_.premises;
    p.theme = foot.theme, p.feature = foot.feature, p.foot = foot.rings;
    p.walls = std::move(places.walls), p.roof_places = places.roof.size();
    for (std::size_t i = 0; i < p.walls.size(); ++i)
      mounts_.push_back(
          {MountedOn::kWall, p.walls[i].position, p.walls[i].ground_m, mount_heights(p.walls[i], request.storey), i});
    for (const RoofPlace& place : places.roof)
      mounts_.push_back({MountedOn::kRoof, place.position, place.roof_m, request.poles, 0});
  }

  SurveyedBuilding survey(std::span<const MastView> masts) && {
    for (const MastView& mast : masts) add(mast);
    choose_best();
    return std::move(found_);
  }

 private:
  void add(const MastView& mast) {
    MastLinks links(scene_, mast, mounts_, request_.radius);
    if (!links.reaches_any()) return;
    found_.lines += links.judge();
    PremisesLink link;
    link.mast = mast.number;
    links.for_each([&](std::size_t i, const MountVerdict& found) {
      if (found.verdict != Verdict::kVisible) return;
      const Mounting mounting = links.mounting(i, found.height);
      keep_least(mounting.on == MountedOn::kWall ? link.wall : link.roof, mounting,
                 [](const Mounting& m) { return std::pair(m.height_m, m.distance_m); });
      if (mounting.on == MountedOn::kWall) serve(found_.premises.walls[mounts_[i].wall], mounting, mast);
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

  /// Lets the mast serve a wall where no other does so from a lower height, or from as low and nearer.
  static void serve(WallPlace& wall, const Mounting& mounting, const MastView& mast) {
    const auto rank = std::pair(mounting.height_m, mounting.distance_m);
    if (wall.mast && std::pair(wall.height_m, wall.distance_m) <= rank) return;
    wall.mast = mast.number;
    std::tie(wall.height_m, wall.distance_m) = rank;
  }

  void note_undecided(const MastLinks& links) {
    links.for_each([&](std::size_t i, const MountVerdict& found) {
      if (mounts_[i].on == MountedOn::kWall && found.verdict == Verdict::kUndecided)
        found_.premises.walls[mounts_[i].wall].undecided = true;
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
    const auto obstacle = scene_.obstacle(mast.view, {tried.position.x, tried.position.y, tried.elevation_m()});
    if (!obstacle) return std::nullopt;
    link.blocker = LinkBlocker{.theme = obstacle->theme, .name = {}, .position = obstacle->position};
    return obstacle->within;
  }

  static bool any_undecided(const MastLinks& links) {
    bool any = false;
    links.for_each([&](std::size_t, const MountVerdict& found) { any = any || found.verdict == Verdict::kUndecided; });
    return any;
  }

  void choose_best() {
    Premises& p = found_.premises;
    const auto rank = [&](std::size_t i) {
      const PremisesLink& link = p.links[i];
      const Mounting& m = link.wall ? *link.wall : *link.roof;
      return std::tuple(m.on, m.height_m, m.distance_m);
    };
    for (std::size_t i = 0; i < p.links.size(); ++i)
      if (p.links[i].verdict == Verdict::kVisible && (!p.best || rank(i) < rank(*p.best))) p.best = i;
    for (WallPlace& wall : p.walls) wall.undecided = wall.undecided && !wall.mast;
  }

  const PremisesRequest& request_;
  const PlaceScene& scene_;
  std::vector<Mount> mounts_;
  SurveyedBuilding found_;
};

}  // namespace

SurveyedBuilding survey_building(const BuildingFoot& foot, const PremisesRequest& request, const MountRules& rules,
                                 const PlaceScene& scene, const PlacedSurface& ground,
                                 std::span<const MastView> masts) {
  return BuildingSurvey(foot, request, scene, mount_places(foot, scene.surface(), ground, rules)).survey(masts);
}

}  // namespace itin::viewshed
