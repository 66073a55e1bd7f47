// The map of a survey of dwellings: their outlines in the colours of how much shadow flicker they have, and the
// turbines, over the relief.
#pragma once

#include <string>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// Returns the bytes of a .png or .pdf, by the ending of `name`. The title block has the project and the date of
/// `sheets`. Throws Cancelled.
std::string dwelling_map(const Store& store, const DwellingsSurvey& survey, const profile::SheetChoice& sheets,
                         const std::string& name, Progress& progress);

}  // namespace itin::viewshed
