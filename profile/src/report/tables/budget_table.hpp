// The table of a link budget.
#pragma once

#include "report/tables/tables.hpp"

namespace itin::profile {

/// Precondition: the report has a budget.
Table budget_table(const LosReport& report);

}  // namespace itin::profile
