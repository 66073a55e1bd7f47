#include "places/place_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <itin/grid_units.hpp>
#include <itin/precondition.hpp>
#include <itin/same_place.hpp>

#include "bounds/boundary.hpp"
#include "line/set_bits.hpp"

namespace itin::viewshed {

PlaceScene::PlaceScene(Tin surface, const LinkJudgement& rules, const Progress& progress)
    : surface_(std::move(surface), progress),
      nodata_(rules.nodata),
      rays_(surface_.tin, rules.earth),
      blockers_(surface_.pyramid, rules.earth) {
  if (rules.fresnel) zone_.emplace(surface_.pyramid, nullptr, rules.earth, *rules.fresnel);
  if (nodata_ != NoData::kClear) rim_ = rim_of(surface_.tin, boundary_edges(surface_.tin));
}

Point3 PlaceScene::in_units(const Point3& metres) const {
  const Point2 place = place_in_units(surface_.tin.grid, {metres.x, metres.y});
  return {place.x, place.y, metres.z / surface_.tin.grid.resolution};
}

PlaceScene::View PlaceScene::view_from(const Point3& mast) const {
  View view{in_units(mast)};
  if (nodata_ != NoData::kClear) view.shadow = std::make_shared<const VoidShadow>(rim_, view.eye, nodata_);
  return view;
}

PlaceScene::Verdicts PlaceScene::judge(const View& view, std::span<const Point3> places) const {
  ITIN_PRECONDITION(places.size() <= kAtOnce);
  Verdicts verdicts;
  verdicts.fill(Verdict::kVisible);
  SightLines lines;
  lines.start_at(view.eye);
  for (unsigned i = 0; i < places.size(); ++i) {
    const Point3 place = in_units(places[i]);
    lines.to_x[i] = place.x, lines.to_y[i] = place.y, lines.to_z[i] = place.z;
    if (!same_place(place.x - view.eye.x, place.y - view.eye.y)) lines.active |= 1U << i;
  }
  const unsigned hidden = lines.active == 0 ? 0 : rays_.hidden(lines);
  for_each_bit(hidden, [&](unsigned i) { verdicts[i] = Verdict::kHidden; });
  lines.active &= ~hidden;
  const unsigned cut = zone_ && lines.active != 0 ? zone_->certainly_cut(lines) : 0;
  for_each_bit(cut, [&](unsigned i) { verdicts[i] = Verdict::kZoneCut; });
  for_each_bit(lines.active & ~cut, [&](unsigned i) {
    if (view.shadow && view.shadow->holds(lines.to_x[i], lines.to_y[i])) verdicts[i] = view.shadow->shaded();
  });
  return verdicts;
}

std::vector<Verdict> PlaceScene::judge_all(const View& view, std::span<const Point3> places,
                                           const Progress& progress) const {
  std::vector<Verdict> all;
  while (all.size() < places.size()) {
    progress.throw_if_cancelled();
    const auto some = places.subspan(all.size()).first(std::min(kAtOnce, places.size() - all.size()));
    const Verdicts verdicts = judge(view, some);
    all.insert(all.end(), verdicts.begin(), verdicts.begin() + static_cast<std::ptrdiff_t>(some.size()));
  }
  return all;
}

std::optional<PlaceScene::Obstacle> PlaceScene::obstacle(const View& view, const Point3& place) const {
  constexpr double kWithin = 0.05;
  const Point3 from = in_units(place);
  std::uint32_t triangle = 0;
  double at = 0;
  if (const auto blocker = blockers_.find(from, view.eye)) {
    triangle = blocker->triangle, at = blocker->at;
  } else if (const auto cut = zone_ ? zone_->first_cut(from, view.eye) : std::nullopt) {
    triangle = cut->triangle, at = cut->at;
  } else {
    return std::nullopt;
  }
  const Tin& tin = surface_.tin;
  const double dx = view.eye.x - from.x, dy = view.eye.y - from.y;
  const double farther = std::min(1.0, at + kWithin / tin.grid.resolution / std::hypot(dx, dy));
  const auto along = [&](double s) { return place_in_metres(tin.grid, {from.x + s * dx, from.y + s * dy}); };
  return Obstacle{tin.theme(tin.triangles[triangle]), along(at), along(farther)};
}

}  // namespace itin::viewshed
