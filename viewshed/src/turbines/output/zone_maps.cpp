#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "turbines/farm_combinations.hpp"
#include "turbines/output/count_classes.hpp"
#include "turbines/proposal.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

constexpr const char* kNone = "None visible";
constexpr const char* kUndecided = "Undecided, across ground without data";

/// Puts the cells of the first class that leave something undecided into a last class, and counts all. Without counts
/// of the undecided nothing is.
void count_cells(const Zone& zone, const std::vector<std::uint16_t>& undecided, ZoneMap& map) {
  const bool leaves_open = zone.leaves_open() && !undecided.empty();
  if (leaves_open) map.classes.push_back({kUndecided, kUndecidedGrey, 0, 0, true});
  const auto last = static_cast<std::uint8_t>(map.classes.size() - 1);
  for (std::size_t i = 0; i < map.class_of_cell.size(); ++i) {
    std::uint8_t& of_cell = map.class_of_cell[i];
    if (of_cell == kNoMapClass) continue;
    const bool open = leaves_open && undecided[i] > 0;
    if (open && of_cell == 0) of_cell = last;
    ++map.classes[of_cell].cells;
    if (open) ++map.classes[of_cell].open_cells;
  }
}

/// Returns the map of counts in bands, the first of which has no more than 0.
ZoneMap banded_map(const Zone& zone, const std::vector<ValueBand>& bands, const std::vector<std::uint16_t>& counts,
                   const std::vector<std::uint16_t>& undecided) {
  ZoneMap map;
  for (const ValueBand& band : bands) map.classes.push_back({band.label, band.colour});
  map.classes.front().label = kNone;
  for (const std::uint16_t count : counts)
    map.class_of_cell.push_back(count == kCountOutside ? kNoMapClass
                                                       : static_cast<std::uint8_t>(band_of(bands, count)));
  count_cells(zone, undecided, map);
  return map;
}

/// Returns the map of hubs, which says whose hubs are known where not all are.
ZoneMap hub_map(const Zone& zone, const std::vector<std::uint16_t>& counts,
                const std::vector<std::uint16_t>& undecided) {
  ZoneMap map = banded_map(zone, count_bands(zone, TurbinePart::kHub), counts, undecided);
  const std::string known = of_known_hubs(zone);
  map.title = "Zone of theoretical visibility: hubs" + known;
  map.heading = "Turbines with their hub visible";
  if (known.empty()) return map;
  map.heading += fmt::format(", of the {} whose hub height is known", known_hubs(zone));
  map.classes.front().label = "None of these visible";
  return map;
}

ZoneMap tip_map(const Zone& zone, const std::vector<std::uint16_t>& counts,
                const std::vector<std::uint16_t>& undecided) {
  ZoneMap map = banded_map(zone, count_bands(zone, TurbinePart::kTip), counts, undecided);
  map.title = "Zone of theoretical visibility: blade tips", map.heading = "Turbines with their blade tip visible";
  return map;
}

ZoneMap farm_map(const Zone& zone, const Visibility& visibility, std::size_t most) {
  const std::vector<std::uint32_t> farms = farm_combinations(zone, visibility);
  const CombinationCells cells = cells_by_combination(farms);
  std::vector<Combination> present = commonest_first(combinations_present(zone, {&farms}), cells);
  std::erase_if(present, [](const Combination& c) { return c.farms == 0; });
  ZoneMap map;
  map.title = "Cumulative zone of theoretical visibility: blade tips by wind farm";
  map.heading = "Wind farms with a blade tip visible";
  map.classes.push_back({kNone, kTransparent});
  std::map<std::uint32_t, std::uint8_t> class_of{{0, 0}, {kOutsideFarms, kNoMapClass}};
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (i < most) map.classes.push_back({present[i].name, distinct_colour(i)});
    if (i == most) map.classes.push_back({"other combinations", {90, 90, 90}});
    class_of[present[i].farms] = static_cast<std::uint8_t>(map.classes.size() - 1);
  }
  for (const std::uint32_t of_cell : farms) map.class_of_cell.push_back(class_of[of_cell]);
  count_cells(zone, visibility.tip_undecided, map);
  return map;
}

ZoneMap proposal_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map = banded_map(zone, count_bands(proposed_turbines(zone.request.turbines), zone.request.count_bands),
                           proposed_tips(zone, visibility), visibility.tip_undecided);
  map.title = "Zone of theoretical visibility of the proposal: blade tips";
  map.heading = "Proposed turbines with their blade tip visible";
  return map;
}

ZoneMap addition_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map;
  map.title = "Additional visibility: what the proposal adds to other turbines";
  map.heading = "Whose blade tips are visible";
  for (const AdditionClass& c : kAdditions) map.classes.push_back({c.text, c.colour});
  map.classes.front().label = kNone;
  map.class_of_cell = additions(zone, visibility);
  count_cells(zone, visibility.tip_undecided, map);
  return map;
}

void add_map(std::vector<ZoneMap>& maps, ZoneMap map, const char* name, const char* seen, bool screened) {
  map.name = std::string(name) + (screened ? "-screened" : ""), map.seen = seen, map.screened = screened;
  maps.push_back(std::move(map));
}

void add_season(std::vector<ZoneMap>& maps, ZoneMap map, const char* name, const char* seen,
                const std::string& season) {
  map.title += " through woods in " + season;
  map.name = name + ("-" + season), map.seen = seen, map.screened = true, map.season = season;
  maps.push_back(std::move(map));
}

}  // namespace

std::vector<ZoneMap> zone_maps(const Zone& zone, std::size_t most_combinations) {
  std::vector<ZoneMap> maps;
  const std::size_t farms = farms_of(zone.request.turbines).size();
  const auto add_all = [&](const Visibility& v, bool screened) {
    add_map(maps, tip_map(zone, v.tip_count, v.tip_undecided), "tip-count", "tip", screened);
    if (known_hubs(zone) > 0) add_map(maps, hub_map(zone, v.hub_count, v.hub_undecided), "hub-count", "hub", screened);
    if (has_proposal(zone.request)) {
      add_map(maps, proposal_map(zone, v), "proposal-tip-count", "proposal", screened);
      add_map(maps, addition_map(zone, v), "additional", "additional", screened);
    }
    if (farms > 1) add_map(maps, farm_map(zone, v, most_combinations), "farms", "farms", screened);
  };
  add_all(zone.bare, false);
  if (zone.screened) add_all(*zone.screened, true);
  const auto add_both = [&](const SeasonCounts& counts, const char* season) {
    add_season(maps, tip_map(zone, counts.tip_count, {}), "tip-count", "tip", season);
    if (known_hubs(zone) > 0) add_season(maps, hub_map(zone, counts.hub_count, {}), "hub-count", "hub", season);
  };
  if (zone.seasons) add_both(zone.seasons->summer, "summer"), add_both(zone.seasons->winter, "winter");
  return maps;
}

std::optional<ZoneMap> radar_map(const Zone& zone) {
  if (!zone.radar) return std::nullopt;
  const RadarView& radar = *zone.radar;
  const std::vector<ValueBand> bands = radar_bands();
  ZoneMap map;
  map.name = "radar-height", map.seen = "radar", map.title = "Least heights that the radar sees";
  map.heading = "Least height above the ground that the radar sees";
  for (const ValueBand& band : bands) map.classes.push_back({band.label, band.colour});
  map.classes.push_back({fmt::format("None up to {:g} m", kRadarCeiling), kTransparent});
  const auto none = static_cast<std::uint8_t>(bands.size()), undecided = static_cast<std::uint8_t>(none + 1);
  if (radar.leaves_open()) map.classes.push_back({kUndecided, kUndecidedGrey, 0, 0, true});
  const auto class_of = [&](std::size_t cell) -> std::uint8_t {
    if (zone.bare.tip_count[cell] == kCountOutside) return kNoMapClass;
    if (!std::isnan(radar.height_m[cell])) return static_cast<std::uint8_t>(band_of(bands, radar.height_m[cell]));
    const bool open = radar.leaves_open() && !std::isnan(radar.undecided_height_m[cell]);
    return open ? undecided : none;
  };
  for (std::size_t cell = 0; cell < radar.height_m.size(); ++cell) {
    map.class_of_cell.push_back(class_of(cell));
    if (map.class_of_cell.back() != kNoMapClass) ++map.classes[map.class_of_cell.back()].cells;
  }
  return map;
}

}  // namespace itin::viewshed
