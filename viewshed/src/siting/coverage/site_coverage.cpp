#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/surface.hpp>

#include "plan/partition.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "siting/coverage/cell_blocks.hpp"
#include "siting/coverage/group_survey.hpp"
#include "siting/coverage/site_window.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

namespace {

/// Peak memory per point: of an envelope, and of a surface that is swept.
constexpr std::uint64_t kBytesPerRayPoint = 1200, kBytesPerSweptPoint = 400;
/// The first pass reads at most one in so many of the full surface's points: fewer where a second pass is cheap, since
/// the memory holds the full surface for all of them.
constexpr std::uint64_t kFirstShare = 2, kFirstShareOfWhole = 8;
/// Points of the full surface about each site.
constexpr double kSiteNearPoints = 128;
/// Options; fewer of them make less of what they share.
constexpr std::size_t kJudgedTogether = 32;
/// No coarse look at so few points: the full surface is as fast.
constexpr std::uint64_t kFewPoints = 40000;

/// The share of the time, about, that reading a surface takes before it is judged from all sites.
constexpr double kReading = 0.2;

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
  return CellBlocks(grid).element_count();
}
std::size_t element_of(const RasterGrid& grid, RasterGrid::Cell cell) {
  return CellBlocks(grid).element(cell);
}
RasterGrid::Cell cell_of(const RasterGrid& grid, std::size_t element) {
  return CellBlocks(grid).cell(element);
}

class SiteCoverage::Impl {
 public:
  Impl(const Store& store, SiteSurvey survey, Progress& progress)
      : store_(store),
        survey_(std::move(survey)),
        progress_(progress),
        themed_(survey_.themes.includes_raised(store.metadata().themes)) {
    if (survey_.positions.empty()) throw InputError("no site to look from: give at least one on the data");
    require_room_for_sets();
    Box box;
    for (const SitePosition& place : survey_.positions) box.extend(disc_box(place.position, survey_.radius));
    choose_levels(box);
    // A target on a roof is seen from afar as one so high above the bare ground may be.
    if (survey_.targets.on_surface && themed_) raise_ = store.greatest_feature_height(survey_.themes, box);
    states_.resize(survey_.positions.size());
    parallel_for(states_.size(), [&](std::size_t i) {
      const CoverageBounds reach{{}, within_reach(survey_.targets, survey_.positions[i].position, survey_.radius)};
      // Copies have no room to grow: bytes_of_coverage() counts on that.
      states_[i].bounds = states_[i].first = reach;
    });
  }

  /// Over the envelopes of all options, group by group, so that what is found does not depend on what was found before.
  void explore() {
    CallProgress call(progress_);
    const auto together = groups(all_options(), looks_.front());
    std::size_t left = together.size();
    for (const std::vector<std::size_t>& group : together) {
      call.step(1 / static_cast<double>(left--));
      std::vector<std::size_t> fresh;
      std::copy_if(group.begin(), group.end(), std::back_inserter(fresh),
                   [&](std::size_t option) { return states_[option].stage < 0; });
      if (!fresh.empty()) judge_group(fresh, group, 0, call);
    }
    call.finish();
  }

  /// Each option's next stage.
  void refine(std::span<const std::size_t> options) {
    std::vector<std::vector<std::size_t>> at_stage(static_cast<std::size_t>(last_stage()) + 1);
    for (const std::size_t option : options) {
      if (!states_[option].bounds.exact)
        at_stage[static_cast<std::size_t>(states_[option].stage + 1)].push_back(option);
    }
    std::erase_if(at_stage, [](const auto& some) { return some.empty(); });
    CallProgress call(progress_);
    std::size_t left = at_stage.size();
    for (const auto& some : at_stage) judge(some, call.step(1 / static_cast<double>(left--)));
    call.finish();
  }

  struct State {
    CoverageBounds bounds, first;
    int stage = -1;  ///< of the last look
  };
  const State& state(std::size_t option) const { return states_[option]; }
  int last_stage() const { return static_cast<int>(looks_.size()) - 1; }

  std::string stage_name(int stage) const {
    if (stage < 0) return "radius alone";
    const Look& look = looks_[static_cast<std::size_t>(stage)];
    if (look.binned) return "bounds, with themes";
    if (look.themed) return "exact, with themes";
    if (look.level == 0) return themed_ ? "exact, bare terrain" : "exact";
    return fmt::format("tolerance {:g} m", store_.metadata().levels[static_cast<std::size_t>(look.level)].tolerance);
  }

  void restore(std::size_t option, int stage, const CoverageBounds& bounds) {
    if (stage == 0) states_[option].first = CoverageBounds(bounds);
    states_[option].bounds = CoverageBounds(bounds);
    states_[option].stage = stage;
  }

  void release_surfaces() {
    whole_lattice_.reset();
    whole_ = {};
  }

  const Statistics& statistics() const { return statistics_; }
  std::function<void(std::size_t, int, const CoverageBounds&)>* on_refined = nullptr;

 private:
  void require_room_for_sets() {
    sets_ = bytes_of_coverage(survey_);
    if (sets_ <= survey_.memory_bytes / 4 * 3) return;
    throw InputError(fmt::format(
        "what {} sites may serve takes {:.2g} GB, too much for {:.2g} GB of memory: give a greater `cell_size`, a "
        "smaller `radius`, fewer sites, or more `memory_bytes`",
        survey_.positions.size(), static_cast<double>(sets_) / 1e9, static_cast<double>(survey_.memory_bytes) / 1e9));
  }

  void choose_levels(const Box& box) {
    const std::uint64_t all = store_.points_about(0, box);
    whole_fits_ = fits(all * (themed_ ? 3 : 1), survey_.positions.size(), 0) || read_whole_lattice();
    if (themed_ && !survey_.tolerance) {
      // Over a surface in memory, a site is judged exactly in the time that its bounds would take.
      if (!whole_fits_) looks_.push_back({.themed = true, .binned = true});
      looks_.push_back({.themed = true});
      return;
    }
    // To look at cells exactly takes no longer than to look at them coarsely.
    const bool exact_at_once = all <= kFewPoints || (survey_.targets.grid && whole_fits_);
    const int first = survey_.tolerance ? level_within(store_.metadata(), *survey_.tolerance)
                      : exact_at_once
                          ? 0
                          : finest_level_of(store_, box, all / (whole_fits_ ? kFirstShareOfWhole : kFirstShare));
    looks_.push_back({.level = first});
    if (first > 0) looks_.push_back({});
    if (themed_) looks_.push_back({.themed = true});
  }

  /// Takes little memory, but whether it is one is known only then.
  bool read_whole_lattice() {
    if (themed_ || survey_.fresnel || !survey_.targets.grid || casts_rays()) return false;
    Stopwatch watch;
    whole_lattice_ = retrieve_lattice(store_, window_of(all_options()), Detail::tolerance(0), ThemeChoice::none(),
                                      LatticeReader::Heights::kAll,
                                      (memory() - std::min(memory(), sets_ / 2)) / kBytesPerPost, progress_);
    statistics_.retrieval_seconds += watch.lap();
    return whole_lattice_.has_value();
  }

  std::vector<std::size_t> all_options() const {
    std::vector<std::size_t> all(survey_.positions.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }

  /// Cells are judged over the full surface at its own level; everything else over envelopes.
  bool judges_cells_exactly(int level) const { return level == 0 && survey_.targets.grid; }
  bool casts_rays() const { return survey_.engine == Engine::kRays; }
  /// For surfaces; what is left is for the rest of the program.
  std::uint64_t memory() const { return (survey_.memory_bytes - sets_) / 4 * 3; }
  /// Whether so many options can be looked at together over a surface of so many points.
  bool fits(std::uint64_t points, std::size_t options, int level) const {
    const bool swept = judges_cells_exactly(level) && !casts_rays();
    // Judging them makes bounds anew, which mostly hold half of what is within reach.
    const std::uint64_t sets = sets_ / survey_.positions.size() * options / 2;
    return points * (swept ? kBytesPerSweptPoint : kBytesPerRayPoint) + sets <= memory();
  }

  /// What a stage judges over: the bare terrain of a level, or the full surface with the themes; or bins of this.
  struct Look {
    int level = 0;
    bool themed = false;
    bool binned = false;
  };

  using Options = std::span<std::size_t>;

  std::uint64_t points_of(Options options, int level) const {
    Box box;
    for (const std::size_t option : options) box.extend(disc_box(survey_.positions[option].position, survey_.radius));
    return store_.points_about(level, box);
  }

  /// Neighbours together, as many as the memory holds.
  std::vector<std::vector<std::size_t>> groups(std::vector<std::size_t> options, const Look& look) const {
    if (look.binned) return {std::move(options)};
    const int level = look.level;
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
  std::pair<Options, Options> halves_across(Options options) const {
    Box box;
    for (const std::size_t option : options) box.extend(survey_.positions[option].position);
    std::sort(options.begin(), options.end(), [&](std::size_t a, std::size_t b) {
      const Point2 p = survey_.positions[a].position, q = survey_.positions[b].position;
      const double pa = box.width() > box.height() ? p.x : p.y, pb = box.width() > box.height() ? q.x : q.y;
      return pa != pb ? pa < pb : a < b;
    });
    return halves(options);
  }

  /// Takes the options, all at one stage, to the next.
  void judge(const std::vector<std::size_t>& options, Progress& progress) {
    const int stage = states_[options.front()].stage + 1;
    CallProgress call(progress);
    const auto together = groups(options, looks_[static_cast<std::size_t>(stage)]);
    std::size_t left = together.size();
    for (const std::vector<std::size_t>& group : together)
      judge_group(group, group, stage, call.step(1 / static_cast<double>(left--)));
  }

  /// Over coarse surfaces zones take as long as over the full one, which is looked at next, if the memory holds it.
  bool zones_at(int level) const { return level == 0 || !whole_fits_; }

  std::unique_ptr<GroupSurvey> survey_of(const std::vector<std::size_t>& group, const Look& look, Progress& progress) {
    if (look.binned) return binned(progress);
    return judges_cells_exactly(look.level) ? exact_cells(group, look.themed, progress)
                                            : enveloped(group, look.level, look.themed, progress);
  }

  /// About all sites, whatever the group.
  std::unique_ptr<GroupSurvey> binned(Progress& progress) {
    Stopwatch watch;
    auto survey = survey_by_bins(store_, survey_, memory(), statistics_, progress);
    statistics_.retrieval_seconds += watch.lap();
    return survey;
  }

  Request request_of(std::span<const std::size_t> options, bool themed) const {
    Request request = viewshed::request_of(survey_, options);
    if (!themed) request.target_height += raise_;
    return request;
  }

  std::unique_ptr<GroupSurvey> exact_cells(const std::vector<std::size_t>& group, bool themed, Progress& progress) {
    Stopwatch watch;
    CallProgress call(progress);
    const Window window = window_of(group);
    const Detail full = Detail::tolerance(0);
    // Zones are cut by triangles one by one.
    const std::uint64_t most_posts = survey_.fresnel || casts_rays() ? 0 : kAnyLattice;
    Surface surface = whole_lattice_
                          ? std::move(*std::exchange(whole_lattice_, std::nullopt))
                          : retrieve_surface(store_, window, full, themed ? survey_.themes : ThemeChoice::none(),
                                             most_posts, call.step(kReading));
    count(surface.statistics(), surface.triangle_count());
    std::optional<Tin> bare_ground;
    if (themed && !survey_.targets.on_surface) {
      bare_ground = triangulate(store_, window, full, call.step(kReading), ThemeChoice::none());
      count(bare_ground->statistics, bare_ground->triangles.size());
    }
    statistics_.retrieval_seconds += watch.lap();
    std::vector<Point2> eyes_of_rays;
    if (casts_rays())
      for (const std::size_t option : group) eyes_of_rays.push_back(survey_.positions[option].position);
    auto survey = survey_cells_exactly(survey_, std::move(surface), std::move(bare_ground), eyes_of_rays);
    statistics_.scene_seconds += watch.lap();
    return survey;
  }

  std::unique_ptr<GroupSurvey> enveloped(const std::vector<std::size_t>& group, int level, bool themed,
                                         Progress& progress) {
    Stopwatch watch;
    const Request request = request_of(group, themed);
    EnvelopeRequest read = what_to_read(group, level);
    if (themed) {
      read.themes = survey_.themes;
      if (!survey_.targets.on_surface) read.bare_ground = read.window;
    }
    Envelope envelope = envelop(store_, read, progress);
    count(envelope.lower.statistics, envelope.lower.triangles.size());
    statistics_.retrieval_seconds += watch.lap();
    const bool zones = survey_.fresnel && zones_at(level);
    const auto survey = survey_.targets.grid ? survey_cells : survey_points;
    auto result = survey(survey_, request, std::move(envelope), zones);
    statistics_.scene_seconds += watch.lap();
    return result;
  }

  void count(const RetrievalStatistics& retrieval, std::size_t triangles) {
    statistics_.retrieval += retrieval;
    statistics_.triangles += triangles;
  }

  /// The full surface about all sites, once and for all, where the memory holds it: bare, and then with the themes.
  const GroupSurvey& whole_survey(const Look& look, CallProgress& call) {
    std::unique_ptr<GroupSurvey>& whole = whole_[look.themed ? 1 : 0];
    if (!whole) whole = survey_of(all_options(), look, call.step(kReading));
    return *whole;
  }

  /// `options` among those of the group, over whose surface they are looked at.
  void judge_group(const std::vector<std::size_t>& options, const std::vector<std::size_t>& group, int stage,
                   Progress& progress) {
    CallProgress call(progress);
    const Look& look = looks_[static_cast<std::size_t>(stage)];
    std::unique_ptr<GroupSurvey> own;
    if (look.binned || look.level > 0 || !whole_fits_) own = survey_of(group, look, call.step(kReading));
    const GroupSurvey& survey = own ? *own : whole_survey(look, call);
    // Few at a time: a run that is killed goes on from what has been settled.
    for (std::size_t first = 0; first < options.size(); first += kJudgedTogether) {
      const auto begin = options.begin() + static_cast<std::ptrdiff_t>(first);
      const auto count = static_cast<std::ptrdiff_t>(std::min(kJudgedTogether, options.size() - first));
      call.step(static_cast<double>(count) / static_cast<double>(options.size() - first));
      judge_some({begin, begin + count}, survey, stage, call);
    }
  }

  void judge_some(const std::vector<std::size_t>& options, const GroupSurvey& survey, int stage, Progress& progress) {
    const Look& look = looks_[static_cast<std::size_t>(stage)];
    Stopwatch watch;
    std::vector<const CoverageBounds*> before;
    for (const std::size_t option : options) before.push_back(&states_[option].bounds);
    std::vector<CoverageBounds> after =
        survey.judge({request_of(options, look.themed), options, before}, progress, statistics_);
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (themed_ && !look.themed) after[i].certain = {}, after[i].exact = false;  // features may hide it
      if (survey_.fresnel && !zones_at(look.level)) after[i].certain = {};         // or its zone is cut
      settle(options[i], stage, std::exchange(after[i], {}));
    }
    statistics_.lines_seconds += watch.lap();
  }

  Window window_of(const std::vector<std::size_t>& group) const {
    return group.size() > 1 ? window_about(survey_.positions, group, survey_.radius)
                            : Window::disc(survey_.positions[group.front()].position, survey_.radius);
  }

  /// Less about each site than a single viewshed reads: they are many.
  EnvelopeRequest what_to_read(const std::vector<std::size_t>& group, int level) const {
    EnvelopeRequest read;
    read.level = level;
    read.window = window_of(group);
    for (const std::size_t option : group) {
      const Point2 position = survey_.positions[option].position;
      read.observers.push_back(position);
      if (level == 0) continue;
      const double points = static_cast<double>(store_.points_about(0, disc_box(position, survey_.radius)));
      const double share = std::sqrt(kSiteNearPoints / std::max(points, kSiteNearPoints));
      read.discs.push_back({position, survey_.radius * share, 0});
      if (level > 1) read.discs.push_back({position, 2 * survey_.radius * share, 1});
    }
    return read;
  }

  void settle(std::size_t option, int stage, const CoverageBounds& bounds) {
    restore(option, stage, bounds);
    if (on_refined != nullptr && *on_refined) (*on_refined)(option, stage, states_[option].bounds);
  }

  const Store& store_;
  SiteSurvey survey_;
  Progress& progress_;
  bool themed_;
  double raise_ = 0;
  std::uint64_t sets_ = 0;  ///< bytes, of what is known of all options
  bool whole_fits_ = false;
  std::optional<Surface> whole_lattice_;  ///< until it is looked at
  std::array<std::unique_ptr<GroupSurvey>, 2> whole_;
  std::vector<Look> looks_;  ///< of each stage
  std::vector<State> states_;
  Statistics statistics_;
};

SiteCoverage::SiteCoverage(const Store& store, SiteSurvey survey, Progress& progress)
    : impl_(std::make_unique<Impl>(store, std::move(survey), progress)) {
  impl_->on_refined = &on_refined;
}
SiteCoverage::~SiteCoverage() = default;

const CoverageBounds& SiteCoverage::bounds(std::size_t option) const {
  return impl_->state(option).bounds;
}
void SiteCoverage::refine(std::span<const std::size_t> options) {
  impl_->refine(options);
}
void SiteCoverage::explore() {
  impl_->explore();
}
void SiteCoverage::release_surfaces() {
  impl_->release_surfaces();
}
int SiteCoverage::stage(std::size_t option) const {
  return impl_->state(option).stage;
}
int SiteCoverage::last_stage() const {
  return impl_->last_stage();
}
const CoverageBounds& SiteCoverage::first_bounds(std::size_t option) const {
  return impl_->state(option).first;
}
std::string SiteCoverage::stage_name(int stage) const {
  return impl_->stage_name(stage);
}
void SiteCoverage::restore(std::size_t option, int stage, CoverageBounds bounds) {
  impl_->restore(option, stage, bounds);
}
const Statistics& SiteCoverage::statistics() const {
  return impl_->statistics();
}

}  // namespace itin::viewshed
