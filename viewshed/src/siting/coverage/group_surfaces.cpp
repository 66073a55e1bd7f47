#include "siting/coverage/group_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <itin/call_progress.hpp>

#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "run/surface_reader.hpp"
#include "siting/coverage/site_window.hpp"

namespace itin::viewshed {

namespace {

/// The number of points of the full surface that are read about each site.
constexpr double kSiteNearPoints = 128;

}  // namespace

GroupSurfaces::GroupSurfaces(const Store& store, const SiteSurvey& survey, const SurveyStages& stages,
                             Statistics& statistics)
    : store_(store), survey_(survey), stages_(stages), statistics_(statistics) {
  if (survey_.targets.on_surface && stages_.themed())
    raise_ = store.greatest_feature_height(survey_.themes, reach_of(survey_));
}

bool GroupSurfaces::read_whole_lattice(Progress& progress) {
  if (stages_.themed() || survey_.level || survey_.fresnel || !survey_.targets.grid || stages_.casts_rays())
    return false;
  const std::uint64_t memory = stages_.memory();
  whole_lattice_ = SurfaceReader(store_, Detail::tolerance(0), statistics_)
                       .lattice(window_about(survey_, all_options(survey_)), ThemeChoice::none(),
                                (memory - std::min(memory, stages_.sets() / 2)) / kBytesPerPost, progress);
  return whole_lattice_.has_value();
}

const GroupSurvey& GroupSurfaces::survey_of(const std::vector<std::size_t>& group, const StageSurface& surface,
                                            Progress& progress) {
  if (!last_ || last_->group != group || last_->surface != surface) {
    last_.reset();  // the memory holds one
    last_ = {group, surface, read(group, surface, progress)};
  }
  return *last_->survey;
}

std::unique_ptr<GroupSurvey> GroupSurfaces::read(const std::vector<std::size_t>& group, const StageSurface& surface,
                                                 Progress& progress) {
  if (survey_.level) return survey_levels(store_, survey_);
  if (surface.binned()) return binned(progress);
  return stages_.judges_cells_exactly(surface.level) ? exact_cells(group, surface.themed(), progress)
                                                     : enveloped(group, surface, progress);
}

const GroupSurvey& GroupSurfaces::whole(const StageSurface& surface, Progress& progress) {
  std::unique_ptr<GroupSurvey>& whole = whole_[surface.themed() ? 1 : 0];
  if (!whole) {
    last_.reset();
    whole = read(all_options(survey_), surface, progress);
  }
  return *whole;
}

void GroupSurfaces::release() {
  whole_lattice_.reset();
  whole_ = {};
  last_.reset();
}

Request GroupSurfaces::request_of(std::span<const std::size_t> options, bool themed) const {
  Request request = viewshed::request_of(survey_, options);
  if (!themed) request.target_height += raise_;
  return request;
}

/// Bins the surface about all sites, whatever the group.
std::unique_ptr<GroupSurvey> GroupSurfaces::binned(Progress& progress) {
  Stopwatch watch;
  auto survey = survey_by_bins(store_, survey_, stages_.memory(), statistics_, progress);
  statistics_.retrieval_seconds += watch.lap();
  return survey;
}

std::unique_ptr<GroupSurvey> GroupSurfaces::exact_cells(const std::vector<std::size_t>& group, bool themed,
                                                        Progress& progress) {
  CallProgress call(progress);
  const Window window = window_about(survey_, group);
  SurfaceReader reader(store_, Detail::tolerance(0), statistics_);
  const bool reads_two = themed && !survey_.targets.on_surface;
  // Fresnel zones are tested against single triangles, so that no lattice is read.
  const std::uint64_t most_posts = survey_.fresnel || stages_.casts_rays() ? 0 : kAnyLattice;
  RetrievedSurface surface = whole_lattice_ ? std::move(*std::exchange(whole_lattice_, std::nullopt))
                                            : reader.surface(window, themed ? survey_.themes : ThemeChoice::none(),
                                                             most_posts, call.step(reads_two ? 0.5 : 1));
  std::optional<Tin> bare_ground;
  if (reads_two) bare_ground = reader.triangles(window, ThemeChoice::none(), call.step(1));
  Stopwatch watch;
  auto survey = survey_cells_exactly(survey_, std::move(surface), std::move(bare_ground), stages_.casts_rays());
  statistics_.scene_seconds += watch.lap();
  return survey;
}

std::unique_ptr<GroupSurvey> GroupSurfaces::enveloped(const std::vector<std::size_t>& group,
                                                      const StageSurface& surface, Progress& progress) {
  Stopwatch watch;
  const Request request = request_of(group, surface.themed());
  EnvelopeRequest read = what_to_read(group, surface.level);
  if (surface.themed()) {
    read.themes = survey_.themes;
    if (!survey_.targets.on_surface) read.bare_ground = read.window;
  }
  Envelope envelope = envelop(store_, read, progress);
  statistics_.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch.lap());
  const auto survey = survey_.targets.grid ? survey_cells : survey_points;
  auto result = survey(survey_, request, std::move(envelope), stages_.judges_zones(surface.level));
  statistics_.scene_seconds += watch.lap();
  return result;
}

/// Reads less about each site than a single viewshed does, since the sites are many.
EnvelopeRequest GroupSurfaces::what_to_read(const std::vector<std::size_t>& group, int level) const {
  EnvelopeRequest read;
  read.level = level;
  read.window = window_about(survey_, group);
  for (const std::size_t option : group) {
    const Point2 position = survey_.positions[option].position;
    if (level == 0) continue;
    const double points = static_cast<double>(store_.points_about(0, square_about(position, survey_.radius)));
    const double share = std::sqrt(kSiteNearPoints / std::max(points, kSiteNearPoints));
    read.discs.push_back({position, survey_.radius * share, 0});
    if (level > 1) read.discs.push_back({position, 2 * survey_.radius * share, 1});
  }
  return read;
}

}  // namespace itin::viewshed
