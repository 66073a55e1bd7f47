// The survey of premises as tables and as layers for a GIS.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// A row for each building: what serves it from where, or what is in the way.
std::string premises_csv(const PremisesSurvey& survey);
/// A row for each building and mast within reach.
std::string premises_links_csv(const PremisesSurvey& survey);

/// A row for each place on the roofs: the mast that serves it with the least pole, and the least pole that sees the
/// street.
std::string premises_roofs_csv(const PremisesSurvey& survey);

/// An object for each mast.
Document masts_document(const PremisesSurvey& survey);

/// The layers premises, facades, links and masts, with their styles.
std::vector<VectorLayer> premises_layers(const PremisesSurvey& survey);

}  // namespace itin::viewshed
