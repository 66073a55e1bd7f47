// The survey of dwellings as a JSON document.
#pragma once

#include <itin/document.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// `crs`, `surface`, `refraction`, `turbines` (how many), `flicker` (its rules), `dwellings` (counts) and `statistics`.
Document dwellings_document(const DwellingsSurvey& survey);

}  // namespace itin::viewshed
