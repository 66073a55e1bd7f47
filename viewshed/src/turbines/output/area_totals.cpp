#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/table_columns.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

/// A class of a map, and how many cells the map has in all.
struct AreaRow {
  const ZoneMap& map;
  std::string name;
  ZoneMap::Class cells;
  std::uint64_t all;
};

std::string surface_of(const ZoneMap& map) {
  if (!map.season.empty()) return map.season;
  return map.screened ? "screened" : "bare";
}

/// Returns the rows of a map: its classes, any tip or hub seen, and all.
std::vector<AreaRow> rows_of_map(const ZoneMap& map) {
  ZoneMap::Class any{"any", {}}, all{"all", {}};
  for (const ZoneMap::Class& c : map.classes) {
    all.cells += c.cells, all.open_cells += c.open_cells;
    if (&c == &map.classes.front() || c.undecided) continue;
    any.cells += c.cells, any.open_cells += c.open_cells;
  }
  std::vector<AreaRow> rows;
  for (const ZoneMap::Class& c : map.classes)
    rows.push_back({map,
                    &c == &map.classes.front() ? kNoneSeen
                    : c.undecided              ? kUndecidedSeen
                                               : c.label,
                    c, all.cells});
  for (const ZoneMap::Class& c : {any, all}) rows.push_back({map, c.label, c, all.cells});
  return rows;
}

}  // namespace

std::string area_totals(const Zone& zone) {
  constexpr std::size_t kAnyCombination = 250;
  // The decimals suffice to tell the km2 of one cell from those of two.
  const std::string number =
      fmt::format("{{:.{}f}}", static_cast<int>(std::clamp(1 + std::ceil(-std::log10(zone.km2(1))), 2.0, 6.0)));
  const auto percent = [](const AreaRow& row) {
    return 100.0 * static_cast<double>(row.cells.cells) / static_cast<double>(std::max<std::uint64_t>(1, row.all));
  };
  const std::vector<TableColumn<AreaRow>> columns{
      {"surface", [](const AreaRow& row) { return surface_of(row.map); }},
      {"seen", [](const AreaRow& row) { return row.map.seen; }},
      {"class", [](const AreaRow& row) { return row.name; }},
      {"area_km2", [&](const AreaRow& row) { return zone.km2(row.cells.cells); }, kInCsv, number.c_str()},
      {"share_percent", percent, kInCsv, "{:.2f}"},
      {"undecided_km2", [&](const AreaRow& row) { return zone.km2(row.cells.open_cells); }, kInCsv, number.c_str()}};
  const std::vector<ZoneMap> maps = zone_maps(zone, kAnyCombination);
  std::vector<AreaRow> rows;
  for (const ZoneMap& map : maps)
    for (const AreaRow& row : rows_of_map(map)) rows.push_back(row);
  return csv_of(columns, rows);
}

}  // namespace itin::viewshed
