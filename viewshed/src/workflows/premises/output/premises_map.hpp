// The map of a survey of premises: walls and buildings in the colours of how they are served, over the relief.
#pragma once

#include <string>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// Returns the bytes of a .png or .pdf, by the ending of `name`. The title block has the project and the date of
/// `sheets`. Throws Cancelled.
std::string premises_map(const Store& store, const PremisesSurvey& survey, const profile::SheetChoice& sheets,
                         const std::string& name, Progress& progress);

}  // namespace itin::viewshed
