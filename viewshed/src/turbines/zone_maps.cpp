#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "turbines/count_classes.hpp"
#include "turbines/farm_combinations.hpp"
#include "turbines/proposal.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

constexpr const char* kNone = "None visible";
constexpr const char* kUndecided = "Undecided, across ground without data";

ZoneMap count_map(const Zone& zone, const Visibility& visibility, TurbinePart part) {
  ZoneMap map;
  const CountClasses classes(zone, visibility, part);
  for (const ValueBand& b : classes.classes()) map.classes.push_back({b.label, b.colour});
  map.classes.front().label = kNone;
  if (zone.leaves_open()) map.classes.back().label = kUndecided, map.classes.back().undecided = true;
  map.class_of_cell.assign(visibility.tip_count.size(), kNoMapClass);
  for (std::size_t i = 0; i < map.class_of_cell.size(); ++i) {
    const auto of_cell = classes.of(i);
    if (!of_cell) continue;
    map.class_of_cell[i] = static_cast<std::uint8_t>(*of_cell);
    ++map.classes[*of_cell].cells;
    if (classes.is_open(i)) ++map.classes[*of_cell].open_cells;
  }
  return map;
}

/// Returns the map of hubs, which says whose hubs are known where not all are.
ZoneMap hub_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map = count_map(zone, visibility, TurbinePart::kHub);
  const std::string known = of_known_hubs(zone);
  map.title = "Zone of theoretical visibility: hubs" + known;
  map.heading = "Turbines with their hub visible";
  if (known.empty()) return map;
  map.heading += fmt::format(", of the {} whose hub height is known", known_hubs(zone));
  map.classes.front().label = "None of these visible";
  return map;
}

ZoneMap tip_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map = count_map(zone, visibility, TurbinePart::kTip);
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
  if (zone.leaves_open()) map.classes.push_back({kUndecided, kUndecidedGrey, 0, 0, true});
  const auto last = static_cast<std::uint8_t>(map.classes.size() - 1);
  for (std::size_t i = 0; i < farms.size(); ++i) {
    const bool open = zone.leaves_open() && farms[i] != kOutsideFarms && visibility.tip_undecided[i] > 0;
    map.class_of_cell.push_back(open && farms[i] == 0 ? last : class_of[farms[i]]);
    if (farms[i] == kOutsideFarms) continue;
    ZoneMap::Class& of_cell = map.classes[map.class_of_cell.back()];
    ++of_cell.cells;
    if (open) ++of_cell.open_cells;
  }
  return map;
}

/// Puts the cells of the first class that leave some turbine undecided into a last class, and counts all.
void count_cells(const Zone& zone, const Visibility& visibility, ZoneMap& map) {
  if (zone.leaves_open()) map.classes.push_back({kUndecided, kUndecidedGrey, 0, 0, true});
  const auto last = static_cast<std::uint8_t>(map.classes.size() - 1);
  for (std::size_t i = 0; i < map.class_of_cell.size(); ++i) {
    std::uint8_t& of_cell = map.class_of_cell[i];
    if (of_cell == kNoMapClass) continue;
    const bool open = zone.leaves_open() && visibility.tip_undecided[i] > 0;
    if (open && of_cell == 0) of_cell = last;
    ++map.classes[of_cell].cells;
    if (open) ++map.classes[of_cell].open_cells;
  }
}

ZoneMap proposal_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map;
  map.title = "Zone of theoretical visibility of the proposal: blade tips";
  map.heading = "Proposed turbines with their blade tip visible";
  const std::vector<ValueBand> bands = count_bands(proposed_turbines(zone.request), zone.request.count_bands);
  for (const ValueBand& band : bands) map.classes.push_back({band.label, band.colour});
  map.classes.front().label = kNone;
  for (const std::uint16_t tips : proposed_tips(zone, visibility))
    map.class_of_cell.push_back(tips == kCountOutside ? kNoMapClass : static_cast<std::uint8_t>(band_of(bands, tips)));
  count_cells(zone, visibility, map);
  return map;
}

ZoneMap addition_map(const Zone& zone, const Visibility& visibility) {
  ZoneMap map;
  map.title = "Additional visibility: what the proposal adds to consented and existing turbines";
  map.heading = "Blade tips visible of";
  for (const AdditionClass& c : kAdditions) map.classes.push_back({c.text, c.colour});
  map.classes.front().label = kNone;
  map.class_of_cell = additions(zone, visibility);
  count_cells(zone, visibility, map);
  return map;
}

void add_map(std::vector<ZoneMap>& maps, ZoneMap map, const char* name, const char* seen, bool screened) {
  map.name = std::string(name) + (screened ? "-screened" : ""), map.seen = seen, map.screened = screened;
  maps.push_back(std::move(map));
}

}  // namespace

std::vector<ZoneMap> zone_maps(const Zone& zone, std::size_t most_combinations) {
  std::vector<ZoneMap> maps;
  const std::size_t farms = farms_of(zone).size();
  const auto add_all = [&](const Visibility& v, bool screened) {
    add_map(maps, tip_map(zone, v), "tip-count", "tip", screened);
    if (known_hubs(zone) > 0) add_map(maps, hub_map(zone, v), "hub-count", "hub", screened);
    if (has_proposal(zone.request)) {
      add_map(maps, proposal_map(zone, v), "proposal-tip-count", "proposal", screened);
      add_map(maps, addition_map(zone, v), "additional", "additional", screened);
    }
    if (farms > 1) add_map(maps, farm_map(zone, v, most_combinations), "farms", "farms", screened);
  };
  add_all(zone.bare, false);
  if (zone.screened) add_all(*zone.screened, true);
  return maps;
}

}  // namespace itin::viewshed
