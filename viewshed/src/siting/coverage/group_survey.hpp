// Judges over one surface what a group of sites serves: the targets that are in sight, with a clear Fresnel zone.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <viewshed/site_coverage.hpp>
#include <viewshed/surface.hpp>

#include "request/eye.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

/// Some of the survey's sites, and the bounds known so far.
struct SitesToJudge {
  const Request& request;
  std::span<const std::size_t> options;
  /// The bounds of each option; the elements that they leave open (in `possible`, not in `certain`) are judged.
  std::span<const CoverageBounds* const> bounds;
};

class GroupSurvey {
 public:
  GroupSurvey() = default;
  GroupSurvey(const GroupSurvey&) = delete;
  GroupSurvey& operator=(const GroupSurvey&) = delete;
  virtual ~GroupSurvey() = default;

  /// The new bounds. Throws Cancelled.
  virtual std::vector<CoverageBounds> judge(const SitesToJudge& sites, Progress& progress,
                                            Statistics& statistics) const = 0;
};

/// Returns a survey of cells over bounds of the surface. `survey` must outlive the result, here and below. `zones`
/// tells whether Fresnel zones are judged, too.
std::unique_ptr<GroupSurvey> survey_cells(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                          bool zones);
/// Returns an exact survey of cells over `surface`, which hides, and over the bare ground on which the cells stand
/// where that is another surface. Rays decide if wanted; then the surface is a Tin.
std::unique_ptr<GroupSurvey> survey_cells_exactly(const SiteSurvey& survey, RetrievedSurface surface,
                                                  std::optional<Tin> bare_ground, bool rays);
/// Returns a survey of points, which is exact over an envelope of level 0.
std::unique_ptr<GroupSurvey> survey_points(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                           bool zones);

/// Returns a survey of cells or points by how low and how high the full surface, with what stands on it, is within
/// bins. The bins are as narrow as `bytes` allow. Reads that surface piece by piece. Fresnel zones are not judged.
/// Throws as triangulate() does.
std::unique_ptr<GroupSurvey> survey_by_bins(const Store& store, const SiteSurvey& survey, std::uint64_t bytes,
                                            Statistics& statistics, Progress& progress);

/// Returns an exact survey of the levels that sites give to cells or points. It reads the surface about each site
/// itself.
std::unique_ptr<GroupSurvey> survey_levels(const Store& store, const SiteSurvey& survey);

/// Returns the request for the levels that sites give to cells, without a grid. Its observers are the antennas of the
/// sites, in their order. Precondition: the survey has a level.
Request request_of_levels(const SiteSurvey& survey, std::span<const SitePosition> sites);

/// Returns the request of one option or several, for the parts of viewsheds that take one.
Request request_of(const SiteSurvey& survey, std::span<const std::size_t> options);

Eye eye_at(const Grid& grid, const Request& request, const SitePosition& place);

/// Returns the eye of each site, in their order.
std::vector<Eye> eyes_of(const Grid& grid, const SiteSurvey& survey, const SitesToJudge& sites);

}  // namespace itin::viewshed
