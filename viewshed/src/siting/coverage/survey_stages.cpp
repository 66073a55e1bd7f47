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

/// The first pass reads at most one in so many of the full surface's points: fewer where a second pass is cheap, since
/// the memory holds the full surface for all of them.
constexpr std::uint64_t kFirstShare = 2, kFirstShareOfWhole = 8;
/// No coarse stage for so few points: the full surface is as fast.
constexpr std::uint64_t kFewPoints = 40000;

std::uint64_t required_sets(const SiteSurvey& survey) {
  const std::uint64_t sets = bytes_of_coverage(survey);
  if (sets <= survey.memory_bytes / 4 * 3) return sets;
  throw InputError(fmt::format(
      "what {} sites may serve takes {:.2g} GB, too much for {:.2g} GB of memory: give a greater `cell_size`, a "
      "smaller `radius`, fewer sites, or more `memory_bytes`",
      survey.positions.size(), static_cast<double>(sets) / 1e9, static_cast<double>(survey.memory_bytes) / 1e9));
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
  // Foundations cut into the ground: what the bare one hides may be seen.
  if (themed_ && (!survey_.tolerance || cut_)) {
    // Over a surface in memory, a site is judged exactly in the time that its bounds would take.
    if (!whole_fits_) stages_.push_back({.kind = StageSurface::Kind::kBins});
    stages_.push_back({.kind = StageSurface::Kind::kThemed});
    return;
  }
  // To look at cells exactly takes no longer than to look at them coarsely.
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

/// Whether so many options can be looked at together over a surface of so many points.
bool SurveyStages::fits(std::uint64_t points, std::size_t options, int level) const {
  const bool swept = judges_cells_exactly(level) && !casts_rays();
  // Judging them makes bounds anew, which mostly hold half of what is within reach.
  const std::uint64_t sets = sets_ / survey_.positions.size() * options / 2;
  return points * (swept ? kBytesPerSurfacePoint : kBytesPerCastEnvelopePoint) + sets <= memory();
}

std::uint64_t SurveyStages::points_of(Options options, int level) const {
  return store_.points_about(level, reach_of(survey_, options));
}

std::vector<std::vector<std::size_t>> SurveyStages::groups(std::vector<std::size_t> options,
                                                           const StageSurface& surface) const {
  if (surface.binned()) return {std::move(options)};
  const int level = surface.level;
  const auto fit_or_is_one = [&](Options some) {
    return some.size() < 2 || fits(points_of(some, level), some.size(), level);
  };
  std::vector<std::vector<std::size_t>> result;
  for (const Options some :
       parts_that_fit(Options(options), fit_or_is_one, [&](Options group) { return halves_across(group); }))
    result.emplace_back(some.begin(), some.end());
  return result;
}

/// Those in the west and in the east, or in the south and in the north.
std::pair<SurveyStages::Options, SurveyStages::Options> SurveyStages::halves_across(Options options) const {
  Box box;
  for (const std::size_t option : options) box.extend(survey_.positions[option].position);
  std::sort(options.begin(), options.end(), [&](std::size_t a, std::size_t b) {
    const Point2 p = survey_.positions[a].position, q = survey_.positions[b].position;
    const double pa = box.width() > box.height() ? p.x : p.y, pb = box.width() > box.height() ? q.x : q.y;
    return pa != pb ? pa < pb : a < b;
  });
  return halves(options);
}

}  // namespace itin::viewshed
