// Premises as the demand of sites.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/premises.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

/// Adds to the inputs, which have their positions, the buildings within the radius of any as elements of the demand,
/// and the highest antennas at their places as its points. Throws InputError where there is no building.
void add_premises(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
                  std::vector<std::string>& warnings, Progress& progress);

/// Returns what those of the serving sites that serve anything are to each building. Throws Error where none does.
std::shared_ptr<const PremisesSurvey> survey_of_choice(const Store& store, const SitePlanRequest& request,
                                                       const SiteInputs& inputs, const Choice& choice,
                                                       const JointCoverage& coverage, Progress& progress);

}  // namespace itin::viewshed
