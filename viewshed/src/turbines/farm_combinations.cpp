#include "turbines/farm_combinations.hpp"

#include <algorithm>
#include <set>

#include <itin/parallel.hpp>
#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

std::vector<std::string> farms_of(const Zone& zone) {
  std::vector<std::string> farms;
  for (const Turbine& t : zone.request.turbines)
    if (std::find(farms.begin(), farms.end(), t.farm) == farms.end()) farms.push_back(t.farm);
  return farms;
}

std::vector<std::uint32_t> farm_combinations(const Zone& zone, const Visibility& visibility) {
  const std::vector<std::string> farms = farms_of(zone);
  const std::size_t cells = zone.grid.cell_count();
  // Each farm has the words of its turbines' bits.
  std::vector<std::vector<std::uint32_t>> masks(farms.size(), std::vector<std::uint32_t>(zone.words));
  for (const Turbine& t : zone.request.turbines) {
    const auto farm = static_cast<std::size_t>(std::find(farms.begin(), farms.end(), t.farm) - farms.begin());
    const TurbineBit bit = turbine_bit(t.number);
    masks[farm][bit.grid] |= bit.mask;
  }
  std::vector<std::uint32_t> result(cells, kOutsideFarms);
  const auto columns = static_cast<std::size_t>(zone.grid.columns());
  parallel_for(static_cast<std::size_t>(zone.grid.rows()), [&](std::size_t row) {
    for (std::size_t i = row * columns; i < (row + 1) * columns; ++i) {
      if (visibility.tip_count[i] == kCountOutside) continue;
      result[i] = 0;
      for (std::size_t f = 0; f < farms.size() && f < kMostFarms; ++f)
        for (std::size_t w = 0; w < zone.words; ++w)
          if ((visibility.turbines[w * cells + i] & masks[f][w]) != 0) result[i] |= std::uint32_t{1} << f;
    }
  });
  return result;
}

std::vector<Combination> combinations_present(const Zone& zone,
                                              const std::vector<const std::vector<std::uint32_t>*>& rasters) {
  std::set<std::uint32_t> present;
  for (const auto* raster : rasters)
    for (const std::uint32_t farms : *raster)
      if (farms != kOutsideFarms) present.insert(farms);
  const std::vector<std::string> names = farms_of(zone);
  std::vector<Combination> result;
  for (const std::uint32_t farms : present) {
    Combination& c = result.emplace_back(Combination{farms, ""});
    for (std::size_t f = 0; f < names.size() && f < kMostFarms; ++f) {
      if ((farms >> f & 1) == 0) continue;
      if (!c.name.empty()) c.name += " + ";
      c.name += names[f].empty() ? "(no farm)" : names[f];
    }
    if (farms == 0) c.name = "none";
  }
  return result;
}

}  // namespace itin::viewshed
