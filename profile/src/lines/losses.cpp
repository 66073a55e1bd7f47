#include "lines/losses.hpp"

#include <itin/diffraction.hpp>

namespace itin::profile {

std::optional<PathLosses> losses_over(const Profile& profile, const Antennas& antennas, const LosQuery& query,
                                      const Profile* bare) {
  if (!query.radio || !profile.has_length()) return std::nullopt;
  const EndGrounds top = ends_of(profile);
  const auto ends = above_tops({profile.length_m, antennas.from_m, antennas.to_m}, top.from_m, top.to_m);
  if (!ends) return std::nullopt;
  const Antennas above{ends->from_m, ends->to_m};
  if (query.points_as_given) return path_losses(profile, above, *query.radio, bare);
  return path_losses(with_spacing(profile, greatest_spacing_m(profile.length_m)), above, *query.radio, bare);
}

std::optional<LinkBudget> budget_over(const std::optional<PathLosses>& losses, const LosQuery& query,
                                      const BudgetCourse& course) {
  if (!losses || !query.budget.asks()) return std::nullopt;
  return link_budget(*losses, *query.radio, course, query.budget);
}

}  // namespace itin::profile
