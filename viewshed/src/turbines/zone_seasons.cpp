#include "turbines/zone_seasons.hpp"

#include <algorithm>
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

/// The tips or the hubs of a zone: what each turbine is looked at up to, and where they are counted. The sets of those
/// that are seen from cells are as Visibility::turbines has them, with woods that are solid, and without woods.
struct Counted {
  std::vector<Turbine> turbines;  ///< as high as the part that is looked at
  const std::vector<std::uint32_t>&full, &solid;
  std::vector<std::uint16_t>&summer, &winter;
};

/// The turbines whose hubs are known, and no higher than these.
std::vector<Turbine> up_to_hubs(std::vector<Turbine> turbines) {
  std::erase_if(turbines, [](const Turbine& t) { return !t.hub_height; });
  for (Turbine& t : turbines) t.tip_height = *t.hub_height;
  return turbines;
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
        tiles_(grid_of_tiles(zone.grid)) {}

  Seasons run(Progress& progress) {
    CallProgress call(progress);
    const std::optional<Zone> survey = without_woods(call.step(0.5));
    const Visibility& full = zone_.screened ? *zone_.screened : zone_.bare;
    const Visibility& solid = survey ? *survey->screened : zone_.bare;
    Seasons seasons;
    SeasonCounts &summer = seasons.summer, &winter = seasons.winter;
    summer.hub_count = winter.hub_count = zone_.bare.hub_count;
    std::vector<Counted> parts;
    parts.push_back({zone_.request.turbines, full.turbines, solid.turbines, summer.tip_count, winter.tip_count});
    if (std::vector<Turbine> hubs = up_to_hubs(zone_.request.turbines); !hubs.empty())
      parts.push_back({std::move(hubs), full.hubs, solid.hubs, summer.hub_count, winter.hub_count});
    for (Counted& counted : parts) count_certain(counted);
    count_between(parts, call.step(1));
    call.finish();
    return seasons;
  }

 private:
  /// Surveys the zone without woods; nothing where the bare ground is that, since nothing but woods stands on it.
  std::optional<Zone> without_woods(Progress& progress) const {
    const ThemeChoice solid = themes_.without_vegetation();
    if (!solid.includes_raised(store_.metadata().themes)) return std::nullopt;
    ZoneRequest request = zone_.request;
    request.cell_size.reset(), request.grid = zone_.grid;
    request.themes = solid;
    request.radar.reset(), request.weights.clear();
    return survey_(request, progress);
  }

  bool has(const std::vector<std::uint32_t>& sets, std::size_t cell, std::size_t number) const {
    const RasterBit bit = turbine_bit(number);
    const std::size_t at = bit.grid * zone_.grid.cell_count() + cell;
    return at < sets.size() && (sets[at] & bit.mask) != 0;
  }
  bool is_between(const Counted& counted, std::size_t cell, const Turbine& turbine) const {
    return has(counted.solid, cell, turbine.number) && !has(counted.full, cell, turbine.number);
  }

  /// Counts what woods do not hide.
  void count_certain(Counted& counted) const {
    counted.summer = zone_.bare.tip_count;
    for (std::size_t cell = 0; cell < counted.summer.size(); ++cell) {
      if (counted.summer[cell] == kCountOutside) continue;
      counted.summer[cell] = 0;
      for (const Turbine& t : counted.turbines)
        if (has(counted.full, cell, t.number)) ++counted.summer[cell];
    }
    counted.winter = counted.summer;
  }

  /// Adds what woods alone hide, where enough light comes through.
  void count_between(std::vector<Counted>& all, Progress& progress) const {
    CallProgress call(progress);
    const std::vector<ZonePart> parts = zone_parts(store_, zone_, true);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      CallProgress of_part(call.step(1.0 / static_cast<double>(parts.size() - i)));
      look_through(parts[i], of_part, all);
    }
  }

  void look_through(const ZonePart& part, CallProgress& call, std::vector<Counted>& all) const {
    const std::vector<std::size_t> cells = cells_between(part, all);
    if (cells.empty()) return;
    const ZoneRequest& request = zone_.request;
    const Tin surface = triangulate(store_, part.window, request.detail, call.step(0.4), themes_);
    const std::vector<double> grounds =
        heights_at_centres(store_, zone_.grid, cells, request.detail, ThemeChoice::none(), call);
    const std::vector<Point3> eyes = raised_centres(zone_.grid, cells, grounds, request.observer_height);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CallProgress of_lines(call.step(1.0 / static_cast<double>(all.size() - i)));
      look_through(surface, cells, eyes, of_lines, all[i]);
    }
  }

  void look_through(const Tin& surface, const std::vector<std::size_t>& cells, const std::vector<Point3>& eyes,
                    CallProgress& call, Counted& counted) const {
    const ZoneFoliage& foliage = *zone_.request.foliage;
    const std::vector<Turbine>& turbines = counted.turbines;
    for (std::size_t k = 0; k < turbines.size(); ++k) {
      std::vector<std::size_t> from;
      std::vector<Point3> looking;
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (is_between(counted, cells[i], turbines[k])) from.push_back(cells[i]), looking.push_back(eyes[i]);
      if (from.empty()) continue;
      const auto light = lines_.between(surface, top_of(turbines[k]), looking,
                                        call.step(1.0 / static_cast<double>(turbines.size() - k)));
      for (std::size_t i = 0; i < from.size(); ++i) {
        if (comes_through(foliage, profile::kLeavesOn, light[i].length_m)) ++counted.summer[from[i]];
        if (comes_through(foliage, profile::kLeavesOff, light[i].length_m)) ++counted.winter[from[i]];
      }
    }
  }

  /// The cells of a part from which woods alone hide a tip or a hub.
  std::vector<std::size_t> cells_between(const ZonePart& part, const std::vector<Counted>& all) const {
    const auto is_any_between = [&](std::size_t cell) {
      return std::any_of(all.begin(), all.end(), [&](const Counted& counted) {
        return std::any_of(counted.turbines.begin(), counted.turbines.end(),
                           [&](const Turbine& t) { return is_between(counted, cell, t); });
      });
    };
    std::vector<std::size_t> cells;
    for (const std::size_t tile : part.tiles) {
      for_each_cell(tile_at(zone_.grid, tiles_, tile), [&](std::size_t, RasterGrid::Cell place) {
        if (const std::size_t cell = zone_.grid.index(place); is_any_between(cell)) cells.push_back(cell);
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
};

}  // namespace

Seasons survey_seasons(const Store& store, const Zone& zone, const SolidSurvey& survey, Progress& progress) {
  return SeasonSurvey(store, zone, survey).run(progress);
}

}  // namespace itin::viewshed
