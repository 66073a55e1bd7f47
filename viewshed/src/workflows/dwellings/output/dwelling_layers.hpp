// The survey of dwellings as layers for a GIS.
#pragma once

#include <vector>

#include <itin/vector_export.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// The layers dwellings, facades and turbines, with their styles.
std::vector<VectorLayer> dwelling_layers(const DwellingsSurvey& survey);

}  // namespace itin::viewshed
