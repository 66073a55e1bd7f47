#include "turbines/zone_seasons.hpp"

#include <optional>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/triangulate.hpp>
#include <profile/foliage.hpp>

#include "foliage/foliage_lines.hpp"
#include "foliage/raised_centres.hpp"
#include "foliage/season_light.hpp"
#include "line/cell_tiles.hpp"
#include "turbines/zone_parts.hpp"

namespace itin::viewshed {

namespace {

/// The sets of turbines that are seen from cells, as Visibility::turbines has them: with woods that are solid, and
/// without woods.
struct Bounds {
  std::vector<std::uint32_t> full, solid;
};

/// The request for the zone of what reaches up to the hubs: turbines whose hubs are known, and no higher.
ZoneRequest of_hubs(ZoneRequest request) {
  std::erase_if(request.turbines, [](const Turbine& t) { return !t.hub_height; });
  for (Turbine& t : request.turbines) t.tip_height = *t.hub_height;
  return request;
}

class SeasonSurvey {
 public:
  SeasonSurvey(const Store& store, const Zone& zone, const SolidSurvey& survey)
      : store_(store),
        zone_(zone),
        survey_(survey),
        themes_(zone.request.themes.value_or(ThemeChoice::none())),
        lines_(store, {zone.request.detail, themes_, zone.request.earth},
               {.extinction = zone.request.foliage->extinction,
                .least_transmittance = zone.request.foliage->least_transmittance}),
        tiles_(grid_of_tiles(zone.grid)) {
    request_ = zone.request;
    request_.cell_size.reset(), request_.grid = zone.grid;
    request_.foliage.reset(), request_.radar.reset(), request_.weights.clear();
  }

  Seasons run(Progress& progress) {
    CallProgress call(progress);
    Seasons seasons;
    const std::vector<Turbine>& all = zone_.request.turbines;
    count(all, bounds_of_tips(call.step(0.3)), call.step(0.4), seasons.summer.tip_count, seasons.winter.tip_count);
    const ZoneRequest hubs = of_hubs(request_);
    if (hubs.turbines.empty()) {
      seasons.summer.hub_count = seasons.winter.hub_count = zone_.bare.hub_count;
    } else {
      count(hubs.turbines, bounds_of(hubs, call.step(0.4)), call.step(1), seasons.summer.hub_count,
            seasons.winter.hub_count);
    }
    call.finish();
    return seasons;
  }

 private:
  /// The themes without woods, where any of them stand on the ground.
  std::optional<ThemeChoice> solid_themes() const {
    const ThemeChoice solid = themes_.without_vegetation();
    return solid.includes_raised(store_.metadata().themes) ? std::optional(solid) : std::nullopt;
  }
  std::vector<std::uint32_t> seen_without_woods(ZoneRequest request, const Zone& full, Progress& progress) const {
    request.themes = solid_themes();
    if (!request.themes) return full.bare.turbines;
    return survey_(request, progress).screened->turbines;
  }
  Bounds bounds_of_tips(Progress& progress) const {
    const Visibility& full = zone_.screened ? *zone_.screened : zone_.bare;
    return {full.turbines, seen_without_woods(request_, zone_, progress)};
  }
  Bounds bounds_of(const ZoneRequest& request, Progress& progress) const {
    CallProgress call(progress);
    const Zone full = survey_(request, call.step(0.5));
    std::vector<std::uint32_t> solid = seen_without_woods(request, full, call.step(1));
    return {full.screened ? full.screened->turbines : full.bare.turbines, std::move(solid)};
  }

  bool has(const std::vector<std::uint32_t>& sets, std::size_t cell, std::size_t number) const {
    const RasterBit bit = turbine_bit(number);
    const std::size_t at = bit.grid * zone_.grid.cell_count() + cell;
    return at < sets.size() && (sets[at] & bit.mask) != 0;
  }
  bool is_between(const Bounds& bounds, std::size_t cell, std::size_t number) const {
    return has(bounds.solid, cell, number) && !has(bounds.full, cell, number);
  }

  /// Counts the turbines, of which each reaches up to its tip.
  void count(const std::vector<Turbine>& turbines, const Bounds& bounds, Progress& progress,
             std::vector<std::uint16_t>& summer, std::vector<std::uint16_t>& winter) {
    summer = zone_.bare.tip_count;
    for (std::size_t cell = 0; cell < summer.size(); ++cell) {
      if (summer[cell] == kCountOutside) continue;
      summer[cell] = 0;
      for (const Turbine& t : turbines)
        if (has(bounds.full, cell, t.number)) ++summer[cell];
    }
    winter = summer;
    CallProgress call(progress);
    const std::vector<ZonePart> parts = zone_parts(store_, zone_, true);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      CallProgress of_part(call.step(1.0 / static_cast<double>(parts.size() - i)));
      look_through(parts[i], turbines, bounds, of_part, summer, winter);
    }
  }

  void look_through(const ZonePart& part, const std::vector<Turbine>& turbines, const Bounds& bounds,
                    CallProgress& call, std::vector<std::uint16_t>& summer, std::vector<std::uint16_t>& winter) {
    const std::vector<std::size_t> cells = cells_between(part, turbines, bounds);
    if (cells.empty()) return;
    const ZoneRequest& request = zone_.request;
    const Tin surface = triangulate(store_, part.window, request.detail, call.step(0.4), themes_);
    const std::vector<double> grounds =
        heights_at_centres(store_, zone_.grid, cells, request.detail, ThemeChoice::none(), call);
    const std::vector<Point3> eyes = raised_centres(zone_.grid, cells, grounds, request.observer_height);
    const ZoneFoliage& foliage = *request.foliage;
    for (std::size_t k = 0; k < turbines.size(); ++k) {
      std::vector<std::size_t> to;
      std::vector<Point3> targets;
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (is_between(bounds, cells[i], turbines[k].number)) to.push_back(cells[i]), targets.push_back(eyes[i]);
      if (to.empty()) continue;
      const auto light = lines_.between(surface, top_of(turbines[k]), targets,
                                        call.step(1.0 / static_cast<double>(turbines.size() - k)));
      for (std::size_t i = 0; i < to.size(); ++i) {
        if (comes_through(foliage, profile::kLeavesOn, light[i].length_m)) ++summer[to[i]];
        if (comes_through(foliage, profile::kLeavesOff, light[i].length_m)) ++winter[to[i]];
      }
    }
  }

  std::vector<std::size_t> cells_between(const ZonePart& part, const std::vector<Turbine>& turbines,
                                         const Bounds& bounds) const {
    std::vector<std::size_t> cells;
    for (const std::size_t tile : part.tiles) {
      for_each_cell(tile_at(zone_.grid, tiles_, tile), [&](std::size_t, RasterGrid::Cell place) {
        const std::size_t cell = zone_.grid.index(place);
        for (const Turbine& t : turbines) {
          if (!is_between(bounds, cell, t.number)) continue;
          cells.push_back(cell);
          break;
        }
      });
    }
    return cells;
  }

  Point3 top_of(const Turbine& turbine) const {
    const auto& all = zone_.request.turbines;
    std::size_t k = 0;
    while (all[k].number != turbine.number) ++k;
    return {turbine.position.x, turbine.position.y, zone_.ground_m[k] + turbine.tip_height};
  }

  const Store& store_;
  const Zone& zone_;
  const SolidSurvey& survey_;
  ThemeChoice themes_;
  FoliageLines lines_;
  RasterGrid tiles_;
  ZoneRequest request_;  ///< that of the zone, with woods that are solid
};

}  // namespace

Seasons survey_seasons(const Store& store, const Zone& zone, const SolidSurvey& survey, Progress& progress) {
  return SeasonSurvey(store, zone, survey).run(progress);
}

}  // namespace itin::viewshed
