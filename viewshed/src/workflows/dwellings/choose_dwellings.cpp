#include "workflows/dwellings/choose_dwellings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/in_ring.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

bool holds_place(const BuildingFoot& foot, Point2 place) {
  return std::count_if(foot.rings.begin(), foot.rings.end(), [&](const auto& ring) { return in_ring(ring, place); }) %
             2 !=
         0;
}

Box box_of_foot(const BuildingFoot& foot) {
  Box box;
  for (const std::vector<Point2>& ring : foot.rings)
    for (const Point2& p : ring) box.extend(p);
  return box;
}

void require_turbines_apart(const DwellingsRequest& request, const StoreMetadata& metadata,
                            const std::vector<BuildingFoot>& feet) {
  for (const BuildingFoot& foot : feet) {
    const Box box = box_of_foot(foot);
    for (const Turbine& turbine : request.turbines.turbines)
      if (box.contains(turbine.position) && holds_place(foot, turbine.position))
        throw InputError(
            fmt::format("`turbines`: turbine {} at {:.10g},{:.10g} stands within a building of {}; move it, "
                        "or leave the building out of `themes`",
                        turbine.number, turbine.position.x, turbine.position.y,
                        metadata.themes[foot.theme - std::size_t{1}].name),
            "turbines");
  }
}

class DwellingChooser {
 public:
  DwellingChooser(const DwellingsRequest& request, const StoreMetadata& metadata, const std::vector<BuildingFoot>& feet)
      : request_(request), metadata_(metadata), feet_(feet) {
    if (!request.dwelling_theme.empty()) require_theme();
  }

  void take_buildings() {
    for (std::size_t i = 0; i < feet_.size(); ++i)
      if (is_of_theme(feet_[i])) add_building(i);
    if (all_.feet.empty())
      throw InputError("`themes`: none of them has buildings; give `dwellings`, or import buildings", "themes");
  }

  /// Takes a given place: the building that it lies on, or else the place in the open.
  void take_place(const SitePlace& place) {
    const auto foot = std::find_if(feet_.begin(), feet_.end(), [&](const BuildingFoot& f) {
      return is_of_theme(f) && box_of_foot(f).contains(place.position) && holds_place(f, place.position);
    });
    if (foot != feet_.end()) {
      Dwelling& dwelling = add_building(static_cast<std::size_t>(foot - feet_.begin()));
      dwelling.name = place.name, dwelling.position = place.position;
      return;
    }
    all_.dwellings.push_back({.name = place.name, .position = place.position});
    all_.feet.emplace_back();
  }

  /// Returns those within reach. Throws InputError where there is none, Cancelled.
  ChosenDwellings within_reach_of_turbines(const Progress& progress) && {
    ChosenDwellings kept;
    double nearest_m = kInfinity;
    for (std::size_t i = 0; i < all_.dwellings.size(); ++i) {
      progress.throw_if_cancelled();
      Dwelling& dwelling = all_.dwellings[i];
      const bool in_shadow = find_nearest(dwelling);
      nearest_m = std::min(nearest_m, dwelling.nearest_m);
      if (!in_shadow && dwelling.nearest_m > request_.radius) continue;
      kept.dwellings.push_back(std::move(dwelling)), kept.feet.push_back(all_.feet[i]);
    }
    if (kept.dwellings.empty())
      throw InputError(fmt::format("no dwelling is within the `radius` of {:g} m of a turbine, nor within reach of its "
                                   "shadow; the nearest is {:.0f} m away; give a greater `radius`",
                                   request_.radius, nearest_m),
                       "radius");
    return kept;
  }

 private:
  void require_theme() const {
    for (const ThemeInfo& theme : metadata_.themes)
      if (theme.name == request_.dwelling_theme && is_of_buildings(theme) && request_.themes.includes(theme)) return;
    throw InputError(
        fmt::format("`dwelling_theme`: the store has no chosen theme of buildings named '{}'", request_.dwelling_theme),
        "dwelling_theme");
  }

  bool is_of_theme(const BuildingFoot& foot) const {
    return request_.dwelling_theme.empty() ||
           metadata_.themes[foot.theme - std::size_t{1}].name == request_.dwelling_theme;
  }

  Dwelling& add_building(std::size_t foot) {
    const Box box = box_of_foot(feet_[foot]);
    all_.dwellings.push_back({.theme = feet_[foot].theme,
                              .feature = feet_[foot].feature,
                              .position = {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2}});
    all_.feet.emplace_back(foot);
    return all_.dwellings.back();
  }

  /// Finds the nearest turbine, and tells whether the shadow of any may reach the dwelling.
  bool find_nearest(Dwelling& dwelling) const {
    const std::vector<Turbine>& turbines = request_.turbines.turbines;
    bool reached = false;
    dwelling.nearest_m = kInfinity;
    for (std::size_t t = 0; t < turbines.size(); ++t) {
      const double distance = horizontal_distance(dwelling.position, turbines[t].position);
      if (distance < dwelling.nearest_m) dwelling.nearest = t, dwelling.nearest_m = distance;
      reached = reached || may_shade(request_.flicker, turbines[t], dwelling.position);
    }
    return reached;
  }

  const DwellingsRequest& request_;
  const StoreMetadata& metadata_;
  const std::vector<BuildingFoot>& feet_;
  ChosenDwellings all_;
};

}  // namespace

ChosenDwellings choose_dwellings(const DwellingsRequest& request, const StoreMetadata& metadata,
                                 const std::vector<BuildingFoot>& feet, const Progress& progress) {
  require_turbines_apart(request, metadata, feet);
  DwellingChooser chooser(request, metadata, feet);
  if (request.dwellings.places.empty()) chooser.take_buildings();
  for (const SitePlace& place : request.dwellings.places) chooser.take_place(place);
  return std::move(chooser).within_reach_of_turbines(progress);
}

double shadow_reach(const FlickerRules& rules, const Turbine& turbine) {
  if (!turbine.hub_height || !turbine.rotor_diameter) return 0;
  return rules.blade_width ? kReachOfBlade * *rules.blade_width : rules.reach_diameters * *turbine.rotor_diameter;
}

bool may_shade(const FlickerRules& rules, const Turbine& turbine, Point2 place) {
  const double reach = shadow_reach(rules, turbine);
  return reach > 0 && horizontal_distance(place, turbine.position) <= reach;
}

double horizontal_distance(Point2 a, Point2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace itin::viewshed
