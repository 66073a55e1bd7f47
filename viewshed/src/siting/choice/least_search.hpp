// Branch and bound for the choice that serves the least.
#pragma once

#include <optional>
#include <vector>

#include "siting/choice/conflicts.hpp"
#include "siting/choice/shared_demand.hpp"

namespace itin::viewshed {

struct LeastQuestion {
  const Conflicts& conflicts;
  const SharedDemand& demand;
  std::vector<std::size_t> open;  ///< options that may be chosen, ascending
  std::size_t count = 0;
  Weight known = 0;  ///< what some choice serves: only smaller values are of interest
};

struct LeastAnswer {
  Weight bound = 0;  ///< no choice serves less, unless it serves `known` or more
  std::optional<std::vector<std::size_t>> better{};
  double work = 0;  ///< the work done
};

/// Ends when the least is found, or once `work` is done. The root is always looked at.
LeastAnswer search_least(const LeastQuestion& question, double work, Progress& progress);

}  // namespace itin::viewshed
