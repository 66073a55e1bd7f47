// The survey of premises as a JSON document.
#pragma once

#include <itin/document.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// How many buildings are served, how, and how many are not.
Document counts_document(const PremisesCounts& counts);

/// `crs`, `surface`, `refraction`, `premises` (counts), `masts` (what each reaches, serves and serves best) and
/// `statistics`.
Document premises_document(const PremisesSurvey& survey);

}  // namespace itin::viewshed
