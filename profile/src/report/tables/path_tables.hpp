// Tables of what lies along a path: its cover, the edges, the reflection, and the profile itself.
#pragma once

#include <optional>
#include <vector>

#include "report/tables/tables.hpp"

namespace itin::profile {

/// Makes tables of what the path crosses (where anything stands on the ground or ground is without data), of the edges
/// of the losses, and of the point of reflection.
std::vector<Table> path_tables(const LosReport& report);

/// Throws InputError for a spacing of the printed profile that is negative, or so small that the table would have more
/// than 10,000 rows.
void require_table_spacing(const LosReport& report);
/// Makes a table of the profile at the report's spacing, and at every point that the report names. Returns nothing
/// where the report asks for none, or the line has no length. Throws what require_table_spacing() throws.
std::optional<Table> profile_table(const LosReport& report);

}  // namespace itin::profile
