// Computes the losses of a line, at the points that a report uses, and its budget.
#pragma once

#include <optional>

#include <profile/los.hpp>

namespace itin::profile {

/// Returns the losses; nothing without a frequency or a length, and where an antenna is within a feature. `bare` is the
/// ground under raised features, if there are any.
std::optional<PathLosses> losses_over(const Profile& profile, const Antennas& antennas, const LosQuery& query,
                                      const Profile* bare);

/// Returns the budget of a line with these losses; nothing where none is asked for.
std::optional<LinkBudget> budget_over(const std::optional<PathLosses>& losses, const LosQuery& query,
                                      const BudgetCourse& course);

}  // namespace itin::profile
