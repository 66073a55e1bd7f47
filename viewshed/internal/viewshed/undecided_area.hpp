// The area from which it is undecided what is seen of the turbines, since ground without data alone could hide them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

struct UndecidedArea {
  double any_m2 = 0;   ///< area from which none is certainly seen, but one may be
  double more_m2 = 0;  ///< area from which some are certainly seen, and more may be
};

/// Computes the areas from the counts of hubs or of tips, and from how many more may be seen.
UndecidedArea undecided_area(const Zone& zone, const std::vector<std::uint16_t>& counts,
                             const std::vector<std::uint16_t>& undecided);

/// Returns "whether a blade tip is visible from 1.2 km², and how many more are visible from 3.4 km²"; empty where
/// nothing is undecided.
std::string undecided_in_words(const UndecidedArea& tips);

}  // namespace itin::viewshed
