// The columns of link budgets in tables of links.
#pragma once

#include <vector>

#include "report/links/link_columns.hpp"

namespace itin::profile {

/// Adds them where a row has a budget; `with_antennas` also what is lost off the axes of antennas.
void add_budget_columns(const std::vector<LinkRow>& rows, bool with_antennas, std::vector<LinkColumn>& columns);

}  // namespace itin::profile
