#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <itin/csv_cell.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_maps.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

/// Returns how many decimals of km2 tell one cell from two.
int decimals(const Zone& zone) {
  return static_cast<int>(std::clamp(1 + std::ceil(-std::log10(zone.grid.cell_area() / 1e6)), 2.0, 6.0));
}

}  // namespace

std::string area_totals(const Zone& zone) {
  constexpr std::size_t kAnyCombination = 250;
  std::string text = "surface,seen,class,area_km2,share_percent,undecided_km2\n";
  for (const ZoneMap& map : zone_maps(zone, kAnyCombination)) {
    ZoneMap::Class any{"any", {}}, all{"all", {}};
    for (const ZoneMap::Class& c : map.classes) {
      all.cells += c.cells, all.open_cells += c.open_cells;
      if (&c == &map.classes.front() || c.undecided) continue;
      any.cells += c.cells, any.open_cells += c.open_cells;
    }
    const auto add = [&](const std::string& name, const ZoneMap::Class& c) {
      const auto km2 = [&](std::uint64_t cells) { return static_cast<double>(cells) * zone.grid.cell_area() / 1e6; };
      fmt::format_to(std::back_inserter(text), "{},{},{},{:.{}f},{:.2f},{:.{}f}\n", map.screened ? "screened" : "bare",
                     map.seen, csv_cell(name), km2(c.cells), decimals(zone),
                     100.0 * static_cast<double>(c.cells) / static_cast<double>(std::max<std::uint64_t>(1, all.cells)),
                     km2(c.open_cells), decimals(zone));
    };
    for (const ZoneMap::Class& c : map.classes)
      add(&c == &map.classes.front() ? kNoneSeen : c.undecided ? kUndecidedSeen : c.label, c);
    add(any.label, any);
    add(all.label, all);
  }
  return text;
}

}  // namespace itin::viewshed
