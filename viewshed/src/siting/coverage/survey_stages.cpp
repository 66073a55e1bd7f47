#include "siting/coverage/survey_stages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/feature_cuts.hpp>
#include <itin/level_choice.hpp>

#include "plan/memory.hpp"
#include "plan/partition.hpp"
#include "request/request.hpp"
#include "siting/coverage/site_window.hpp"

namespace itin::viewshed {

namespace {

/// The first stage reads at most one in this many of the full surface's points. Fewer are read where a second stage is
/// cheap, since the memory holds the full surface for all sites.
constexpr std::uint64_t kFirstShare = 2, kFirstShareOfWhole = 8;
/// Up to this number of points there is no coarse stage: the full surface is as fast.
constexpr std::uint64_t kFewPoints = 40000;

std::uint64_t required_sets(const SiteSurvey& survey) {
  const std::uint64_t sets = bytes_of_coverage(survey);
  if (sets <= survey.memory_bytes / 4 * 3) return sets;
  throw InputError(
      fmt::format(
          "what {} sites may serve takes {:.2g} GB, too much for {:.2g} GB of memory: give a greater `cell_size`, a "
          "smaller `radius`, fewer sites, or more `memory_bytes`",
          survey.positions.size(), static_cast<double>(sets) / 1e9, static_cast<double>(survey.memory_bytes) / 1e9),
      "memory_bytes");
}

}  // namespace

SurveyStages::SurveyStages(const Store& store, const SiteSurvey& survey)
    : store_(store),
      survey_(survey),
      themed_(survey.themes.includes_raised(store.metadata().themes)),
      sets_(required_sets(survey)),
      reach_(reach_of(survey)),
      points_(store.points_about(0, reach_)),
      cut_(!feature_cuts(store, survey.themes, reach_).empty()) {}

bool SurveyStages::whole_fits_as_triangles() const {
  return fits(points_ * (themed_ ? kPointsWithFeatures : 1), survey_.positions.size(), 0);
}

void SurveyStages::choose(bool whole_fits) {
  whole_fits_ = whole_fits;
  stages_.clear();
  if (survey_.level) {
    stages_.push_back({.kind = themed_ ? StageSurface::Kind::kThemed : StageSurface::Kind::kBareLevel});
    return;
  }
  // Where foundations cut into the ground, a target that the bare ground hides may be seen.
  if (themed_ && (!survey_.tolerance || cut_)) {
    // Over a surface in memory, judging a site exactly takes no longer than bounding it.
    if (!whole_fits_) stages_.push_back({.kind = StageSurface::Kind::kBins});
    stages_.push_back({.kind = StageSurface::Kind::kThemed});
    return;
  }
  // Judging cells exactly takes no longer than judging them coarsely.
  const bool exact_at_once = points_ <= kFewPoints || (survey_.targets.grid && whole_fits_);
  const int first = survey_.tolerance ? level_within(store_.metadata(), *survey_.tolerance)
                    : exact_at_once
                        ? 0
                        : finest_level_of(store_, reach_, points_ / (whole_fits_ ? kFirstShareOfWhole : kFirstShare));
  stages_.push_back({.level = first});
  if (first > 0) stages_.push_back({});
  if (themed_) stages_.push_back({.kind = StageSurface::Kind::kThemed});
}

std::string SurveyStages::name(int stage) const {
  if (stage < 0) return "radius alone";
  const StageSurface& surface = at(stage);
  if (surface.binned()) return "bounds, with themes";
  if (surface.themed()) return "exact, with themes";
  if (surface.level == 0) return themed_ ? "exact, bare terrain" : "exact";
  return fmt::format("tolerance {:g} m", store_.metadata().levels[static_cast<std::size_t>(surface.level)].tolerance);
}

/// Tells whether this many options can be judged together over a surface of this many points.
bool SurveyStages::fits(std::uint64_t points, std::size_t options, int level) const {
  const bool swept = judges_cells_exactly(level) && !casts_rays();
  // Judging makes new bounds, which mostly hold half of the elements within reach.
  const std::uint64_t sets = sets_ / survey_.positions.size() * options / 2;
  return points * (swept ? kBytesPerSurfacePoint : kBytesPerCastEnvelopePoint) + sets <= memory();
}

std::uint64_t SurveyStages::points_of(Options options, int level) const {
  return store_.points_about(level, reach_of(survey_, options));
}

std::vector<SiteGroup> SurveyStages::groups(std::vector<std::size_t> options, const StageSurface& surface) const {
  if (surface.binned() || survey_.level) return {{std::move(options), points_}};
  const int level = surface.level;
  const auto fit_or_is_one = [&](Options some) {
    return some.size() < 2 || fits(points_of(some, level), some.size(), level);
  };
  std::vector<SiteGroup> groups;
  for (const Options some : parts_that_fit(Options(options), fit_or_is_one,
                                           [&](Options group) { return halves_across(survey_.positions, group); }))
    groups.push_back({{some.begin(), some.end()}, points_of(some, level)});
  return groups;
}

Effort SurveyStages::effort_of(const SiteGroup& group, const StageSurface& surface) const {
  const double targets =
      static_cast<double>(survey_.targets.grid ? survey_.targets.grid->cell_count() : survey_.targets.points.size());
  const double lines = targets * static_cast<double>(group.options.size());
  const std::uint64_t points = group.points * (surface.themed() ? kPointsWithFeatures : 1);
  if (judges_cells_exactly(surface.level) && !surface.binned())
    return {effort_of_triangles(points), effort_of_swept_lines(lines)};
  return {effort_of_envelope(points), survey_.targets.grid ? effort_of_swept_lines(lines) : effort_of_lines(lines)};
}

}  // namespace itin::viewshed
