// What some sites serve, judged over one scene: what they see, and of that what their Fresnel zones leave.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <viewshed/site_coverage.hpp>

#include "../certified_pass.hpp"
#include "../eye.hpp"
#include "clear_zone.hpp"

namespace itin::viewshed {

/// What sites are judged over.
struct SiteScene {
  SiteScene(Envelope envelope, const SiteSurvey& survey, const Request& request, const RasterGrid& tiles);

  EnvelopeScene surface;
  std::optional<ClearZone> zone;  ///< where zones are judged, too
};

/// The request of one option or several, for the parts of viewsheds that take one.
Request request_of(const SiteSurvey& survey, std::span<const std::size_t> options);

/// Over cells or points, whichever the survey has. `bounds` has an entry for each option; what they leave open (in
/// `possible`, not in `certain`) is judged, and the new bounds are returned. Exact over a surface of level 0.
std::vector<CoverageBounds> judge_cells(const SiteScene& scene, const SiteSurvey& survey, const Request& request,
                                        std::span<const std::size_t> options,
                                        std::span<const CoverageBounds* const> bounds, Progress& progress,
                                        Statistics& statistics);
std::vector<CoverageBounds> judge_points(const SiteScene& scene, const SiteSurvey& survey, const Request& request,
                                         std::span<const std::size_t> options,
                                         std::span<const CoverageBounds* const> bounds, Progress& progress,
                                         Statistics& statistics);

/// Where points lie, for EnvelopeScene.
RasterGrid bins_of_points(const std::vector<Point2>& points);

Eye eye_at(const Grid& grid, const Request& request, const SiteStand& stand);

}  // namespace itin::viewshed
