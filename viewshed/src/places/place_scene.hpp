// Links from masts to places over a surface in memory, decided exactly: the line of sight by rays
// (scene/rays/scene.hpp), the Fresnel zone by the definition that lines of sight have, ground without data by the
// request's rule.
//
//   const PlaceScene scene(std::move(tin), {.earth = earth}, progress);
//   const PlaceScene::View view = scene.view_from(mast);
//   const PlaceScene::Verdicts verdicts = scene.judge(view, places);   // up to sixteen
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/lattice_tin.hpp>
#include <itin/tin.hpp>
#include <viewshed/request.hpp>
#include <viewshed/result.hpp>

#include "judge/clear_zone.hpp"
#include "line/sight_lines.hpp"
#include "modes/lines/first_blocker.hpp"
#include "places/mount_places.hpp"
#include "request/void_shadow.hpp"
#include "scene/rays/scene.hpp"

namespace itin::viewshed {

struct LinkJudgement {
  Earth earth = {};
  NoData nodata = NoData::kUnknown;
  std::optional<FresnelCriterion> fresnel = {};  ///< what must be clear besides the line; nothing: the line alone
};

/// Safe for concurrent use.
class PlaceScene {
 public:
  /// Every line that is judged must lie over the part of the store's ground that `surface` holds. Throws Cancelled.
  PlaceScene(Tin surface, const LinkJudgement& rules, const Progress& progress);

  const PlacedSurface& surface() const { return surface_; }

  /// A mast's upper end, and what it does not see across ground without data.
  struct View {
    Point3 eye;                                          ///< grid units
    std::shared_ptr<const VoidShadow> shadow = nullptr;  ///< null where lines pass over such ground
  };
  View view_from(const Point3& mast) const;
  /// Looks as if ground without data hid nothing.
  View view_past_voids(const Point3& from) const { return {in_units(from)}; }

  static constexpr std::size_t kAtOnce = SightLines::kSize;
  using Verdicts = std::array<Verdict, kAtOnce>;
  /// Judges the links to at most kAtOnce places in metres: kVisible, kZoneCut, kHidden or kUndecided. The closer
  /// together the places, the faster.
  Verdicts judge(const View& view, std::span<const Point3> places) const;
  /// Judges the links to any number of places. Throws Cancelled.
  std::vector<Verdict> judge_all(const View& view, std::span<const Point3> places, const Progress& progress) const;

  /// What is in the way of a link.
  struct Obstacle {
    std::uint16_t theme = 0;
    Point2 position;  ///< where it begins to be in the way, seen from the place
    Point2 within;    ///< a little farther on
  };
  /// Finds what is in the way nearest to the place; nothing where no ground is.
  std::optional<Obstacle> obstacle(const View& view, const Point3& place) const;

 private:
  Point3 in_units(const Point3& metres) const;

  const PlacedSurface surface_;
  const NoData nodata_;
  const Scene rays_;
  const FirstBlocker blockers_;
  std::optional<const ClearZone> zone_;
  std::vector<RimEdge> rim_;  ///< empty where ground without data hides nothing
};

}  // namespace itin::viewshed
