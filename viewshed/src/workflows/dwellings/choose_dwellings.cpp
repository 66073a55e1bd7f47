#include "workflows/dwellings/choose_dwellings.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/in_ring.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

class DwellingChooser {
 public:
  /// Throws InputError where a turbine stands within a building, or the theme of dwellings is none; Cancelled.
  DwellingChooser(const DwellingsRequest& request, const StoreMetadata& metadata, const std::vector<BuildingFoot>& feet,
                  const Progress& progress)
      : request_(request), metadata_(metadata), feet_(feet), progress_(progress) {
    for (const BuildingFoot& foot : feet) boxes_.push_back(box_of_rings(foot.rings));
    require_turbines_apart();
    if (!request.dwelling_theme.empty()) require_theme();
  }

  void take_buildings() {
    for (std::size_t i = 0; i < feet_.size(); ++i)
      if (is_of_theme(feet_[i])) add_building(i);
    if (all_.empty())
      throw InputError("`themes`: none of them has buildings; give `dwellings`, or import buildings", "themes");
  }

  /// Takes given places: the buildings that they lie on, or else the places in the open.
  void take_places(const std::vector<SitePlace>& places) {
    for (const SitePlace& place : places) {
      progress_.throw_if_cancelled();
      std::size_t i = 0;
      while (i < feet_.size() && !(is_of_theme(feet_[i]) && holds(i, place.position))) ++i;
      Dwelling& dwelling = i < feet_.size() ? add_building(i) : all_.emplace_back().dwelling;
      dwelling.name = place.name, dwelling.position = place.position;
    }
  }

  /// Returns those within reach. Throws InputError where there is none, Cancelled.
  std::vector<Dwelling> within_reach_of_turbines() && {
    std::vector<Dwelling> kept;
    double nearest_m = kInfinity;
    for (auto& [dwelling, foot] : all_) {
      progress_.throw_if_cancelled();
      const bool in_shadow = find_nearest(dwelling);
      nearest_m = std::min(nearest_m, dwelling.nearest_m);
      if (!in_shadow && dwelling.nearest_m > request_.radius) continue;
      if (foot != nullptr) dwelling.foot = foot->rings;
      kept.push_back(std::move(dwelling));
    }
    if (kept.empty())
      throw InputError(fmt::format("no dwelling is within the `radius` of {:g} m of a turbine, nor within reach of its "
                                   "shadow; the nearest is {:.0f} m away; give a greater `radius`",
                                   request_.radius, nearest_m),
                       "radius");
    return kept;
  }

 private:
  struct Candidate {
    Dwelling dwelling;
    const BuildingFoot* foot = nullptr;  ///< the building that it is; null: in the open
  };

  void require_turbines_apart() const {
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      progress_.throw_if_cancelled();
      for (const Turbine& turbine : request_.turbines.turbines)
        if (holds(i, turbine.position))
          throw InputError(
              fmt::format("`turbines`: turbine {} at {:.10g},{:.10g} stands within a building of {}; move it, "
                          "or leave the building out of `themes`",
                          turbine.number, turbine.position.x, turbine.position.y, theme_of(feet_[i])),
              "turbines");
    }
  }

  void require_theme() const {
    for (const ThemeInfo& theme : metadata_.themes)
      if (theme.name == request_.dwelling_theme && is_of_buildings(theme) && request_.themes.includes(theme)) return;
    throw InputError(
        fmt::format("`dwelling_theme`: the store has no chosen theme of buildings named '{}'", request_.dwelling_theme),
        "dwelling_theme");
  }

  const std::string& theme_of(const BuildingFoot& foot) const {
    return metadata_.themes[foot.theme - std::size_t{1}].name;
  }

  bool is_of_theme(const BuildingFoot& foot) const {
    return request_.dwelling_theme.empty() || theme_of(foot) == request_.dwelling_theme;
  }

  bool holds(std::size_t foot, Point2 place) const {
    return boxes_[foot].contains(place) && in_rings(feet_[foot].rings, place);
  }

  Dwelling& add_building(std::size_t i) {
    const BuildingFoot& foot = feet_[i];
    all_.push_back({{.theme = foot.theme, .feature = foot.feature, .position = middle_of(boxes_[i])}, &foot});
    return all_.back().dwelling;
  }

  /// Finds the nearest turbine, and tells whether the shadow of any may reach the dwelling.
  bool find_nearest(Dwelling& dwelling) const {
    const std::vector<Turbine>& turbines = request_.turbines.turbines;
    bool reached = false;
    dwelling.nearest_m = kInfinity;
    for (std::size_t t = 0; t < turbines.size(); ++t) {
      const double metres = distance(dwelling.position, turbines[t].position);
      if (metres < dwelling.nearest_m) dwelling.nearest = t, dwelling.nearest_m = metres;
      reached = reached || may_shade(request_.flicker, turbines[t], dwelling.position);
    }
    return reached;
  }

  const DwellingsRequest& request_;
  const StoreMetadata& metadata_;
  const std::vector<BuildingFoot>& feet_;
  const Progress& progress_;
  std::vector<Box> boxes_;  ///< one about each of the buildings
  std::vector<Candidate> all_;
};

}  // namespace

std::vector<Dwelling> choose_dwellings(const DwellingsRequest& request, const StoreMetadata& metadata,
                                       const std::vector<BuildingFoot>& feet, const Progress& progress) {
  DwellingChooser chooser(request, metadata, feet, progress);
  if (request.dwellings.places.empty())
    chooser.take_buildings();
  else
    chooser.take_places(request.dwellings.places);
  return std::move(chooser).within_reach_of_turbines();
}

double shadow_reach(const FlickerRules& rules, const Turbine& turbine) {
  if (!turbine.hub_height || !turbine.rotor_diameter) return 0;
  return rules.blade_width ? kReachOfBlade * *rules.blade_width : rules.reach_diameters * *turbine.rotor_diameter;
}

bool may_shade(const FlickerRules& rules, const Turbine& turbine, Point2 place) {
  const double reach = shadow_reach(rules, turbine);
  return reach > 0 && distance(place, turbine.position) <= reach;
}

}  // namespace itin::viewshed
