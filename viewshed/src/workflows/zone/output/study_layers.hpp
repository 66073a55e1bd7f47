// What a study is about as layers for a GIS: turbines, viewpoints, routes, radio links, study area, rings of distance;
// and what is seen through woods.
#pragma once

#include <vector>

#include <itin/raster_regions.hpp>
#include <itin/vector_export.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/output/study_lines.hpp"

namespace itin::viewshed {

/// Returns the layers that the study has, the topmost first, with styles for QGIS.
std::vector<VectorLayer> study_layers(const ZoneStudy& study, const StudyLines& lines);

/// Returns the areas from which tips and hubs are seen through woods in summer and in winter, by bands of their number,
/// as the polygons of each season have them; none where woods are solid.
std::vector<RegionLayer> season_layers(const Zone& zone);

}  // namespace itin::viewshed
