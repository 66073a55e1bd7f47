// What a study is about as layers for a GIS: turbines, viewpoints, routes, radio links, study area, rings of distance.
#pragma once

#include <vector>

#include <itin/vector_export.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/study_lines.hpp"

namespace itin::viewshed {

/// Returns the layers that the study has, the topmost first, with styles for QGIS.
std::vector<VectorLayer> study_layers(const ZoneStudy& study, const StudyLines& lines);

}  // namespace itin::viewshed
