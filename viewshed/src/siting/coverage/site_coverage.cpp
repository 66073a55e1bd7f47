#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_coverage.hpp>

#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "run/segments.hpp"
#include "siting/coverage/crossed_voids.hpp"
#include "siting/coverage/demand_blocks.hpp"
#include "siting/coverage/group_surfaces.hpp"
#include "siting/coverage/served_elements.hpp"
#include "siting/coverage/site_window.hpp"
#include "siting/coverage/survey_stages.hpp"

namespace itin::viewshed {

namespace {

/// The number of options that are judged together; fewer would share less work.
constexpr std::size_t kJudgedTogether = 32;

}  // namespace

std::vector<std::optional<double>> ground_under(const Store& store, const std::vector<Point2>& positions,
                                                const ThemeChoice& themes, Progress& progress) {
  return heights_at(store, positions, Detail::tolerance(0), themes, progress);
}

RasterGrid grid_of_reach(const Store& store, const std::vector<SitePosition>& positions, double radius,
                         double cell_size) {
  Request request;
  for (const SitePosition& place : positions) request.observers.push_back({place.name, place.position, place.height});
  request.radius = radius;
  request.cell_size = cell_size;
  return cells_of(request, extent_of(store));
}

std::size_t element_count(const RasterGrid& grid) {
  return DemandBlocks(grid).element_count();
}
std::size_t element_of(const RasterGrid& grid, RasterGrid::Cell cell) {
  return DemandBlocks(grid).element(cell);
}
RasterGrid::Cell cell_of(const RasterGrid& grid, std::size_t element) {
  return DemandBlocks(grid).cell(element);
}

class SiteCoverage::Impl {
 public:
  Impl(const Store& store, SiteSurvey survey, Progress& progress)
      : crosses_voids_(voids_matter(store, survey, progress)),
        leaves_open_(crosses_voids_ && survey.nodata == NoData::kUnknown),
        survey_(decided_survey(std::move(survey), crosses_voids_)),
        progress_(progress),
        stages_(store, survey_),
        surfaces_(store, survey_, stages_, statistics_) {
    stages_.choose(stages_.whole_fits_as_triangles() || surfaces_.read_whole_lattice(progress_));
    states_.resize(survey_.positions.size());
    parallel_for(states_.size(), [&](std::size_t i) {
      const CoverageBounds reach{{}, within_reach(survey_.targets, survey_.positions[i].position, survey_.radius)};
      // Copies reserve no memory for growth: bytes_of_coverage() counts on that.
      states_[i].bounds = states_[i].first = reach;
      tell_elements(states_[i]);
    });
  }

  /// Judges options over the surfaces of the groups of all options, so that the results do not depend on what was
  /// judged before.
  void explore(std::span<const std::size_t> options) {
    std::vector<std::size_t> fresh;
    std::copy_if(options.begin(), options.end(), std::back_inserter(fresh),
                 [&](std::size_t option) { return states_[option].stage < 0; });
    if (!fresh.empty()) judge(fresh, all_options(survey_), 0, progress_);
  }

  /// Takes each option to its next stage.
  void refine(std::span<const std::size_t> options) {
    std::vector<std::vector<std::size_t>> at_stage(static_cast<std::size_t>(stages_.last_stage()) + 1);
    for (const std::size_t option : options) {
      if (!states_[option].bounds.exact)
        at_stage[static_cast<std::size_t>(states_[option].stage + 1)].push_back(option);
    }
    std::erase_if(at_stage, [](const auto& some) { return some.empty(); });
    const auto effort = [](const std::vector<std::size_t>& some) {
      return Effort{0, static_cast<double>(some.size())};
    };
    for_each_segment(at_stage, effort, progress_, [&](const auto& some, SegmentProgress& of_stage) {
      judge(some, some, states_[some.front()].stage + 1, of_stage.judging());
    });
  }

  struct State {
    CoverageBounds bounds, first;                          ///< what is known of cells or points
    CoverageBounds bounds_of_elements, first_of_elements;  ///< these are empty where each point is an element
    int stage = -1;                                        ///< the last stage judged; -1: none
  };
  /// What is known of the elements that an option serves.
  const CoverageBounds& known(std::size_t option) const {
    return groups_points() ? states_[option].bounds_of_elements : states_[option].bounds;
  }
  const CoverageBounds& first_known(std::size_t option) const {
    return groups_points() ? states_[option].first_of_elements : states_[option].first;
  }
  const State& state(std::size_t option) const { return states_[option]; }
  const SurveyStages& stages() const { return stages_; }

  void restore(std::size_t option, int stage, const CoverageBounds& bounds) {
    if (stage == 0) states_[option].first = CoverageBounds(bounds);
    states_[option].bounds = CoverageBounds(bounds);
    states_[option].stage = stage;
    tell_elements(states_[option]);
  }

  void explore() { explore(all_options(survey_)); }

  void release_surfaces() { surfaces_.release(); }

  const Statistics& statistics() const { return statistics_; }
  bool leaves_open() const { return leaves_open_; }
  std::function<void(std::size_t, int, const CoverageBounds&)>* on_refined = nullptr;

 private:
  bool groups_points() const { return !survey_.targets.elements.empty(); }
  void tell_elements(State& state) const {
    if (!groups_points()) return;
    state.bounds_of_elements = elements_of_points(survey_.targets.elements, state.bounds);
    state.first_of_elements = elements_of_points(survey_.targets.elements, state.first);
  }

  static bool voids_matter(const Store& store, const SiteSurvey& survey, Progress& progress) {
    if (survey.positions.empty()) throw InputError("no site to look from: give at least one on the data");
    return survey.nodata != NoData::kClear && sites_may_cross_voids(store, survey, progress);
  }
  /// Returns the survey under the rule by which the targets count. Where no line crosses ground without data, its rim
  /// need not be examined, and the rule is kClear.
  static SiteSurvey decided_survey(SiteSurvey survey, bool crosses_voids) {
    const bool open_served = survey.nodata == NoData::kUnknown && survey.open == OpenTargets::kServed;
    survey.nodata = crosses_voids && !open_served ? NoData::kBlock : NoData::kClear;
    return survey;
  }

  /// Takes the options, which are all at the stage before, to this stage, group by group of `all`.
  void judge(const std::vector<std::size_t>& options, const std::vector<std::size_t>& all, int stage,
             Progress& progress) {
    std::vector<bool> asked(states_.size());
    for (const std::size_t option : options) asked[option] = true;
    const auto asked_of = [&](const SiteGroup& group) {
      std::vector<std::size_t> some;
      std::copy_if(group.options.begin(), group.options.end(), std::back_inserter(some),
                   [&](std::size_t option) { return asked[option]; });
      return some;
    };
    auto groups = stages_.groups(all, stages_.at(stage));
    std::erase_if(groups, [&](const SiteGroup& group) { return asked_of(group).empty(); });
    const auto effort = [&](const SiteGroup& group) { return stages_.effort_of(group, stages_.at(stage)); };
    for_each_segment(groups, effort, progress, [&](const SiteGroup& group, SegmentProgress& of_group) {
      judge_group(asked_of(group), group.options, stage, of_group);
    });
  }

  /// Judges `options`, some of the group, over the surface of the group, or over that of all sites where the memory
  /// holds it.
  void judge_group(const std::vector<std::size_t>& options, const std::vector<std::size_t>& group, int stage,
                   SegmentProgress& progress) {
    const StageSurface& surface = stages_.at(stage);
    const bool whole = stages_.whole_fits() && !surface.binned() && surface.level == 0;
    const GroupSurvey& survey =
        whole ? surfaces_.whole(surface, progress.reading()) : surfaces_.survey_of(group, surface, progress.reading());
    CallProgress call(progress.judging());
    // Only few are judged at a time, so that a run that is killed can resume from the bounds recorded.
    for (std::size_t first = 0; first < options.size(); first += kJudgedTogether) {
      const auto begin = options.begin() + static_cast<std::ptrdiff_t>(first);
      const auto count = static_cast<std::ptrdiff_t>(std::min(kJudgedTogether, options.size() - first));
      call.step(static_cast<double>(count) / static_cast<double>(options.size() - first));
      judge_some({begin, begin + count}, survey, stage, call);
    }
  }

  void judge_some(const std::vector<std::size_t>& options, const GroupSurvey& survey, int stage, Progress& progress) {
    const StageSurface& surface = stages_.at(stage);
    Stopwatch watch;
    std::vector<const CoverageBounds*> before;
    for (const std::size_t option : options) before.push_back(&states_[option].bounds);
    std::vector<CoverageBounds> after =
        survey.judge({surfaces_.request_of(options, surface.themed()), options, before}, progress, statistics_);
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (stages_.themed() && !surface.themed()) after[i].certain = {}, after[i].exact = false;  // features may hide it
      if (survey_.fresnel && !stages_.judges_zones(surface.level)) after[i].certain = {};        // or its zone is cut
      record_bounds(options[i], stage, std::exchange(after[i], {}));
    }
    statistics_.lines_seconds += watch.lap();
  }

  void record_bounds(std::size_t option, int stage, const CoverageBounds& bounds) {
    restore(option, stage, bounds);
    if (on_refined != nullptr && *on_refined) (*on_refined)(option, stage, states_[option].bounds);
  }

  const bool crosses_voids_;  ///< sight lines may cross ground without data, and the rule does not let them pass
  const bool leaves_open_;
  const SiteSurvey survey_;  ///< its rule is kBlock or kClear
  Progress& progress_;
  Statistics statistics_;
  SurveyStages stages_;
  GroupSurfaces surfaces_;
  std::vector<State> states_;
};

SiteCoverage::SiteCoverage(const Store& store, SiteSurvey survey, Progress& progress)
    : impl_(std::make_unique<Impl>(store, std::move(survey), progress)) {
  impl_->on_refined = &on_refined;
}
SiteCoverage::~SiteCoverage() = default;

const CoverageBounds& SiteCoverage::bounds(std::size_t option) const {
  return impl_->known(option);
}
void SiteCoverage::refine(std::span<const std::size_t> options) {
  impl_->refine(options);
}
void SiteCoverage::explore() {
  impl_->explore();
}
void SiteCoverage::explore(std::span<const std::size_t> options) {
  impl_->explore(options);
}
void SiteCoverage::release_surfaces() {
  impl_->release_surfaces();
}
int SiteCoverage::stage(std::size_t option) const {
  return impl_->state(option).stage;
}
int SiteCoverage::last_stage() const {
  return impl_->stages().last_stage();
}
const CoverageBounds& SiteCoverage::first_bounds(std::size_t option) const {
  return impl_->first_known(option);
}
const CoverageBounds& SiteCoverage::first_bounds_of_targets(std::size_t option) const {
  return impl_->state(option).first;
}
std::string SiteCoverage::stage_name(int stage) const {
  return impl_->stages().name(stage);
}
void SiteCoverage::restore(std::size_t option, int stage, const CoverageBounds& bounds) {
  impl_->restore(option, stage, bounds);
}
const Statistics& SiteCoverage::statistics() const {
  return impl_->statistics();
}
bool SiteCoverage::leaves_open() const {
  return impl_->leaves_open();
}

}  // namespace itin::viewshed
