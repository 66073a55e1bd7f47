// Tables of what lies along a path: its cover, the edges, the reflection, the profile itself.
#pragma once

#include <optional>
#include <vector>

#include "report/tables.hpp"

namespace itin::profile {

/// What the path crosses, where anything stands on the ground or ground is without data; the edges of the losses; the
/// point of reflection.
std::vector<Table> path_tables(const LosReport& report);

/// Throws InputError for a spacing of the printed profile that is negative, or so small that it would have more than
/// 10,000 rows.
void require_table_spacing(const LosReport& report);
/// The profile at the report's spacing, and at every point that the report names; nothing where the report asks for
/// none, or the line has no length. Throws as require_table_spacing() does.
std::optional<Table> profile_table(const LosReport& report);

}  // namespace itin::profile
