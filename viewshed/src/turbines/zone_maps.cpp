#include <algorithm>
#include <map>

#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "turbines/farm_combinations.hpp"
#include "turbines/value_bands.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

constexpr const char* kNone = "None visible";

ZoneMap count_map(const Zone& zone, const std::vector<std::uint16_t>& counts) {
  ZoneMap map;
  const auto bands = count_bands(zone.request.turbines.size(), zone.request.count_bands);
  for (const ValueBand& b : bands) map.classes.push_back({b.to > 0 ? b.label : kNone, b.colour, 0});
  map.class_of_cell.assign(counts.size(), kNoMapClass);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == kCountOutside) continue;
    map.class_of_cell[i] = static_cast<std::uint8_t>(band_of(bands, counts[i]));
    ++map.classes[map.class_of_cell[i]].cells;
  }
  return map;
}

ZoneMap farm_map(const Zone& zone, const Visibility& visibility, std::size_t most) {
  const std::vector<std::uint32_t> farms = farm_combinations(zone, visibility);
  CombinationCells cells = cells_by_combination(farms);
  std::vector<Combination> present = commonest_first(combinations_present(zone, {&farms}), cells);
  std::erase_if(present, [](const Combination& c) { return c.farms == 0; });
  ZoneMap map;
  map.classes.push_back({kNone, kTransparent, cells[0]});
  std::map<std::uint32_t, std::uint8_t> class_of{{0, 0}, {kOutsideFarms, kNoMapClass}};
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (i < most) map.classes.push_back({present[i].name, distinct_colour(i), 0});
    if (i == most) map.classes.push_back({"other combinations", {90, 90, 90}, 0});
    map.classes.back().cells += cells[present[i].farms];
    class_of[present[i].farms] = static_cast<std::uint8_t>(map.classes.size() - 1);
  }
  for (const std::uint32_t f : farms) map.class_of_cell.push_back(class_of[f]);
  return map;
}

void add_map(std::vector<ZoneMap>& maps, ZoneMap map, const char* name, const char* title, const char* heading,
             bool screened) {
  map.name = std::string(name) + (screened ? "-screened" : ""), map.title = title, map.heading = heading;
  map.screened = screened;
  map.seen = map.name.starts_with("farms") ? "farms" : map.name.starts_with("hub") ? "hub" : "tip";
  maps.push_back(std::move(map));
}

}  // namespace

std::vector<ZoneMap> zone_maps(const Zone& zone, std::size_t most_combinations) {
  std::vector<ZoneMap> maps;
  const std::size_t farms = farms_of(zone).size();
  const auto add_all = [&](const Visibility& v, bool screened) {
    add_map(maps, count_map(zone, v.tip_count), "tip-count", "Zone of theoretical visibility: blade tips",
            "Turbines with their blade tip visible", screened);
    if (knows_hubs(zone))
      add_map(maps, count_map(zone, v.hub_count), "hub-count", "Zone of theoretical visibility: hubs",
              "Turbines with their hub visible", screened);
    if (farms > 1)
      add_map(maps, farm_map(zone, v, most_combinations), "farms",
              "Cumulative zone of theoretical visibility: blade tips by wind farm",
              "Wind farms with a blade tip visible", screened);
  };
  add_all(zone.bare, false);
  if (zone.screened) add_all(*zone.screened, true);
  return maps;
}

}  // namespace itin::viewshed
