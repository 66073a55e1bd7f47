#include "turbines/farm_combinations.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <itin/parallel.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/zone_cells.hpp"

namespace itin::viewshed {

namespace {

/// Farms by their bits in 32-bit words.
using FarmSet = std::vector<std::uint32_t>;

/// Tells which farms are seen from a cell.
class FarmSets {
 public:
  explicit FarmSets(const Zone& zone)
      : zone_(zone), names_(farms_of(zone.request.turbines)), words_(bit_grids(names_.size())) {
    // Each farm has the words of its turbines' bits.
    masks_.assign(names_.size(), std::vector<std::uint32_t>(zone.words));
    for (const Turbine& t : zone.request.turbines) {
      const auto farm = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), t.farm) - names_.begin());
      const RasterBit bit = turbine_bit(t.number);
      masks_[farm][bit.grid] |= bit.mask;
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  FarmSet of(const Visibility& visibility, std::size_t cell) const {
    FarmSet farms(words_);
    for (std::size_t w = 0; w < zone_.words; ++w) {
      const std::uint32_t seen = visibility.turbines[w * visibility.tip_count.size() + cell];
      for (std::size_t f = 0; seen != 0 && f < names_.size(); ++f)
        if ((seen & masks_[f][w]) != 0) farms[raster_bit(f).grid] |= raster_bit(f).mask;
    }
    return farms;
  }
  std::string name(const FarmSet& farms) const {
    std::string name;
    for (std::size_t f = 0; f < names_.size(); ++f) {
      if ((farms[raster_bit(f).grid] & raster_bit(f).mask) == 0) continue;
      if (!name.empty()) name += " + ";
      name += names_[f].empty() ? "(no farm)" : names_[f];
    }
    return name.empty() ? "none" : name;
  }

 private:
  const Zone& zone_;
  std::vector<std::string> names_;
  std::size_t words_;
  std::vector<std::vector<std::uint32_t>> masks_;
};

/// Returns the sets of the whole zone, bare or screened, sorted, the empty set first.
std::vector<FarmSet> sets_present(const Zone& zone, const FarmSets& sets) {
  std::set<FarmSet> present{FarmSet(bit_grids(sets.names().size()))};
  const auto add = [&](const Visibility& visibility) {
    FarmSet last;  // neighbours mostly see the same farms
    for_each_cell_with_value(zone, visibility, [&](const Visibility& seen, std::size_t cell, std::size_t) {
      if (FarmSet farms = sets.of(seen, cell); farms != last) present.insert(last = std::move(farms));
    });
  };
  add(zone.bare);
  if (zone.screened) add(*zone.screened);
  return {present.begin(), present.end()};
}

/// Returns the combinations of only those cells from which some turbine is undecided; kOutsideFarms elsewhere.
std::vector<std::uint32_t> where_open(std::vector<std::uint32_t> farms, const Visibility& visibility) {
  for (std::size_t i = 0; i < farms.size(); ++i)
    if (visibility.tip_undecided.empty() || visibility.tip_undecided[i] == 0) farms[i] = kOutsideFarms;
  return farms;
}

std::uint64_t cells_of(const CombinationCells& cells, const Combination& combination) {
  const auto found = cells.find(combination.farms);
  return found == cells.end() ? 0 : found->second;
}

}  // namespace

std::vector<std::uint32_t> farm_combinations(const Zone& zone, const Visibility& visibility) {
  const FarmSets sets(zone);
  const bool bits = sets.names().size() <= kMostFarms;
  const std::vector<FarmSet> numbered = bits ? std::vector<FarmSet>{} : sets_present(zone, sets);
  const auto code = [&](const FarmSet& farms) {
    if (bits) return farms.front();
    return static_cast<std::uint32_t>(std::lower_bound(numbered.begin(), numbered.end(), farms) - numbered.begin());
  };
  std::vector<std::uint32_t> result(zone.grid.cell_count(), kOutsideFarms);
  for_each_part(zone, [&](const Zone& part, RasterGrid::Cell at) {
    const Visibility& seen = of_same_surface(zone, visibility, part);
    parallel_for(static_cast<std::size_t>(part.grid.rows()), [&](std::size_t i) {
      const auto row = static_cast<std::int64_t>(i);
      for (std::int64_t column = 0; column < part.grid.columns(); ++column)
        if (const std::size_t cell = part.grid.index({column, row}); seen.tip_count[cell] != kCountOutside)
          result[zone.grid.index({at.column + column, at.row + row})] = code(sets.of(seen, cell));
    });
  });
  return result;
}

std::vector<Combination> combinations_present(const Zone& zone,
                                              const std::vector<const std::vector<std::uint32_t>*>& rasters) {
  std::set<std::uint32_t> present;
  for (const auto* raster : rasters)
    for (const std::uint32_t farms : *raster)
      if (farms != kOutsideFarms) present.insert(farms);
  const FarmSets sets(zone);
  const bool bits = sets.names().size() <= kMostFarms;
  const std::vector<FarmSet> numbered = bits ? std::vector<FarmSet>{} : sets_present(zone, sets);
  std::vector<Combination> result;
  for (const std::uint32_t farms : present)
    result.push_back({farms, sets.name(bits ? FarmSet{farms} : numbered[farms])});
  return result;
}

CombinationCells cells_by_combination(const std::vector<std::uint32_t>& farms) {
  CombinationCells cells;
  for (const std::uint32_t f : farms)
    if (f != kOutsideFarms) ++cells[f];
  return cells;
}

std::vector<Combination> commonest_first(std::vector<Combination> combinations, const CombinationCells& cells) {
  std::stable_sort(combinations.begin(), combinations.end(),
                   [&](const Combination& a, const Combination& b) { return cells_of(cells, a) > cells_of(cells, b); });
  return combinations;
}

std::string combination_table(const Zone& zone) {
  const std::vector<std::uint32_t> bare = farm_combinations(zone, zone.bare);
  const std::vector<std::uint32_t> screened =
      zone.screened ? farm_combinations(zone, *zone.screened) : std::vector<std::uint32_t>{};
  const CombinationCells bare_cells = cells_by_combination(bare), screened_cells = cells_by_combination(screened),
                         bare_open = cells_by_combination(where_open(bare, zone.bare)),
                         screened_open = zone.screened ? cells_by_combination(where_open(screened, *zone.screened))
                                                       : CombinationCells{};
  const auto present = commonest_first(combinations_present(zone, {&bare, &screened}), bare_cells);
  std::vector<TableColumn<Combination>> columns{{"value", [](const Combination& c) { return c.farms; }},
                                                {"farms_seen", [](const Combination& c) { return c.name; }}};
  const auto add = [&](const char* name, const CombinationCells& cells) {
    const auto km2 = [&zone, &cells](const Combination& c) { return zone.km2(cells_of(cells, c)); };
    columns.emplace_back(name, km2, kInCsv, "{:.6f}");
  };
  add("bare_km2", bare_cells);
  if (zone.screened) add("screened_km2", screened_cells);
  add("bare_undecided_km2", bare_open);
  if (zone.screened) add("screened_undecided_km2", screened_open);
  return csv_of(columns, present);
}

}  // namespace itin::viewshed
