// What some sites serve, judged over one scene.
#pragma once

#include <span>
#include <vector>

#include <viewshed/site_coverage.hpp>

#include "../certified_pass.hpp"
#include "../eye.hpp"

namespace itin::viewshed {

/// The request of one option or several, for the parts of viewsheds that take one.
Request request_of(const SiteSurvey& survey, std::span<const std::size_t> options);

/// Over cells or points, whichever the survey has. `bounds` has an entry for each option; what they leave open (in
/// `possible`, not in `certain`) is judged, and the new bounds are returned. Exact over a scene of level 0.
std::vector<CoverageBounds> judge_cells(const EnvelopeScene& scene, const SiteSurvey& survey, const Request& request,
                                        std::span<const std::size_t> options,
                                        std::span<const CoverageBounds* const> bounds, Progress& progress,
                                        Statistics& statistics);
std::vector<CoverageBounds> judge_points(const EnvelopeScene& scene, const SiteSurvey& survey, const Request& request,
                                         std::span<const std::size_t> options,
                                         std::span<const CoverageBounds* const> bounds, Progress& progress,
                                         Statistics& statistics);

/// Where points lie, for EnvelopeScene.
RasterGrid bins_of_points(const std::vector<Point2>& points);

Eye eye_at(const Grid& grid, const Request& request, const SiteStand& stand);

}  // namespace itin::viewshed
