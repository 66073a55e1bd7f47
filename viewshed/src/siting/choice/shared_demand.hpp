// The demand by the options that serve it: elements that the same options serve form one class.
#pragma once

#include <cstdint>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

struct SharedDemand {
  std::vector<Weight> weights;  ///< one for each class of elements, none 0
  /// What each option certainly serves and existing sites do not, as classes, ascending.
  std::vector<std::vector<std::uint32_t>> of_option;
};

/// Divides the demand into classes; options that are not `open` get none. Where all would take too much memory, the
/// last elements are left out: bounds from below stay true. O(members of the sets).
SharedDemand shared_demand(const ChoiceProblem& problem, const std::vector<bool>& open);

}  // namespace itin::viewshed
