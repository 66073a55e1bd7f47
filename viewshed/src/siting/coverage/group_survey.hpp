// Judges over one surface what a group of sites serves: what they see, and of that what their Fresnel zones leave.
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

/// Some of the survey's sites, and what is known of them.
struct SitesToJudge {
  const Request& request;
  std::span<const std::size_t> options;
  /// One per option: what they leave open (in `possible`, not in `certain`) is judged.
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

/// Surveys cells over bounds of the surface. The survey must outlive it, as it must all of these. `zones`: whether they
/// are judged, too.
std::unique_ptr<GroupSurvey> survey_cells(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                          bool zones);
/// Surveys cells exactly, over what hides them, and the bare ground that they stand on where it is another. Rays decide
/// where the positions of the sites are given, metres; then the surface is a Tin.
std::unique_ptr<GroupSurvey> survey_cells_exactly(const SiteSurvey& survey, Surface surface,
                                                  std::optional<Tin> bare_ground,
                                                  const std::vector<Point2>& eyes_of_rays);
/// Surveys points; exact over an envelope of level 0.
std::unique_ptr<GroupSurvey> survey_points(const SiteSurvey& survey, const Request& request, Envelope envelope,
                                           bool zones);

/// Surveys cells or points by how low and how high the full surface is within bins, with what stands on it; they are as
/// narrow as so many bytes allow. Reads that surface piece by piece. Zones are not judged. Throws as triangulate()
/// does.
std::unique_ptr<GroupSurvey> survey_by_bins(const Store& store, const SiteSurvey& survey, std::uint64_t bytes,
                                            Statistics& statistics, Progress& progress);

/// The request of one option or several, for the parts of viewsheds that take one.
Request request_of(const SiteSurvey& survey, std::span<const std::size_t> options);

Eye eye_at(const Grid& grid, const Request& request, const SitePosition& place);

/// Each site's.
std::vector<Eye> eyes_of(const Grid& grid, const SiteSurvey& survey, const SitesToJudge& sites);

}  // namespace itin::viewshed
