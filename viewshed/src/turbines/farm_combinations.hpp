// Numbers that tell which farms are seen, and their names.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// The combination of farms seen from a cell, as a number. Bit f is set where at least one tip of farm f of
/// farms_of() is seen. With more than kMostFarms farms the number is the combination's index among those that occur in
/// the zone, bare or screened. 0 where none is seen, kOutsideFarms outside.
inline constexpr std::uint32_t kOutsideFarms = 0xffffffff;
inline constexpr std::size_t kMostFarms = 31;
std::vector<std::uint32_t> farm_combinations(const Zone& zone, const Visibility& visibility);

struct Combination {
  std::uint32_t farms = 0;
  std::string name;  ///< "A + B"; "none" for 0
};
/// Returns the combinations that occur in the zone, bare or screened, by ascending number.
std::vector<Combination> combinations_present(const Zone& zone,
                                              const std::vector<const std::vector<std::uint32_t>*>& rasters);

/// The number of cells of each combination, by the combination's number.
using CombinationCells = std::map<std::uint32_t, std::uint64_t>;
/// Counts the cells of each combination, without the cells outside.
CombinationCells cells_by_combination(const std::vector<std::uint32_t>& farms);
/// Sorts the combinations, the one with the most cells first; where the numbers of cells are equal, the order is kept.
std::vector<Combination> commonest_first(std::vector<Combination> combinations, const CombinationCells& cells);

}  // namespace itin::viewshed
