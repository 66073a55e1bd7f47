// Which farms are seen, as a number, and the names of such numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Bit f is farm f of farms_of(): at least one of its tips is seen. Of more than kMostFarms farms it is the number of
/// the combination among those that occur in the zone, bare or screened. 0 where none is seen, kOutsideFarms outside.
inline constexpr std::uint32_t kOutsideFarms = 0xffffffff;
inline constexpr std::size_t kMostFarms = 31;
std::vector<std::uint32_t> farm_combinations(const Zone& zone, const Visibility& visibility);

struct Combination {
  std::uint32_t farms = 0;
  std::string name;  ///< "A + B"; "none" for 0
};
/// Those that occur in the zone, bare or screened, by ascending number.
std::vector<Combination> combinations_present(const Zone& zone,
                                              const std::vector<const std::vector<std::uint32_t>*>& rasters);

}  // namespace itin::viewshed
