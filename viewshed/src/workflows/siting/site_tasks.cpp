#include <algorithm>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <itin/byte_archive.hpp>
#include <viewshed/site_tasks.hpp>

#include "plan/effort.hpp"
#include "plan/partition.hpp"
#include "siting/coverage/site_window.hpp"
#include "workflows/siting/site_planner.hpp"

namespace itin::viewshed {

namespace {

void exchange_set(ValueWriter& writer, const DemandSet& set) {
  std::vector<std::uint32_t> numbers;
  std::vector<std::uint64_t> members;
  for (const DemandSet::Block& block : set.blocks()) numbers.push_back(block.number), members.push_back(block.members);
  writer(numbers, members);
}

/// Throws NotThoseValues where these are no blocks of a set among so many.
void exchange_set(ValueReader& reader, DemandSet& set, std::size_t blocks) {
  std::vector<std::uint32_t> numbers;
  std::vector<std::uint64_t> members;
  reader(numbers, members);
  if (numbers.size() != members.size()) throw NotThoseValues();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] >= blocks || (i > 0 && numbers[i] <= numbers[i - 1])) throw NotThoseValues();
    set.add(numbers[i], members[i]);
  }
}

/// The progress of the call that runs now, for what lives longer than a call.
class ProgressNow final : public Progress {
 public:
  void report(std::string_view stage, double fraction) override { now_->report(stage, fraction); }
  bool cancelled() const override { return now_->cancelled(); }
  void set(Progress& progress) { now_ = &progress; }

 private:
  Progress* now_ = nullptr;
};

}  // namespace

/// One call at a time: a survey is made by all threads.
class SiteTasks::Impl {
 public:
  Impl(const Store& store, SitePlanRequest request, std::uint64_t most_sites, Progress& progress)
      : store_(store), planner_(store, std::move(request), during(progress)), survey_(planner_.survey()) {
    order_.resize(sums_heights() ? planner_.inputs().options.size() : survey_.positions.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    heights_m_.resize(sums_heights() ? order_.size() : 0);
    // A part's sites are next to each other in the order, for its halves are sorted in their place.
    for (const std::span<std::size_t> sites : parts_that_fit(
             std::span(order_), [&](std::span<std::size_t> some) { return some.size() <= most_sites; },
             [&](std::span<std::size_t> some) { return halves_across(survey_.positions, some); }))
      list_.push_back(task_of(sites));
  }

  const std::vector<Task>& list() const { return list_; }

  std::string answer(std::size_t task, Progress& progress) {
    const std::lock_guard one(mutex_);
    during(progress);
    const std::span<const std::size_t> sites = sites_of(task);
    ValueWriter writer;
    if (sums_heights()) {
      writer(planner_.possible_heights({sites.begin(), sites.end()}));
      return writer.bytes();
    }
    coverage().explore(sites);
    for (const std::size_t site : sites) {
      const CoverageBounds& bounds = coverage().first_bounds_of_targets(site);
      writer(std::uint8_t{bounds.exact});
      exchange_set(writer, bounds.certain), exchange_set(writer, bounds.possible);
    }
    return writer.bytes();
  }

  void add(std::size_t task, std::string_view answer) {
    const std::span<const std::size_t> sites = sites_of(task);
    ValueReader reader(answer);
    if (sums_heights()) {
      std::vector<double> heights_m;
      reader(heights_m);
      reader.expect_end();
      if (heights_m.size() != sites.size()) throw NotThoseValues();
      for (std::size_t i = 0; i < sites.size(); ++i) heights_m_[sites[i]] = heights_m[i];
      return;
    }
    std::vector<CoverageBounds> bounds(sites.size());
    for (CoverageBounds& of_site : bounds) {
      std::uint8_t exact = 0;
      reader(exact);
      of_site.exact = exact != 0;
      exchange_set(reader, of_site.certain, blocks()), exchange_set(reader, of_site.possible, blocks());
    }
    reader.expect_end();
    for (std::size_t i = 0; i < sites.size(); ++i) coverage().restore(sites[i], 0, bounds[i]);
  }

  SitePlan take(Progress& progress) {
    during(progress);
    if (sums_heights()) planner_.take_heights(std::move(heights_m_));
    return std::move(planner_).plan(coverage());
  }

 private:
  Progress& during(Progress& progress) {
    progress_.set(progress);
    return progress_;
  }

  bool sums_heights() const { return planner_.request().sums_heights(); }

  std::span<const std::size_t> sites_of(std::size_t task) const {
    return std::span(order_).subspan(static_cast<std::size_t>(list_.at(task).north_west.column),
                                     static_cast<std::size_t>(list_[task].columns));
  }

  /// The survey is begun once it is needed: whoever plans a job needs none.
  SiteCoverage& coverage() {
    if (!coverage_) coverage_.emplace(store_, survey_, progress_);
    return *coverage_;
  }

  Task task_of(std::span<const std::size_t> sites) const {
    Task task{{sites.data() - order_.data(), 0}, static_cast<std::int64_t>(sites.size()), 1};
    task.eyes = sites.size();
    task.points = store_.points_about(0, reach_of(survey_, sites));
    double lines = 0;
    for (const std::size_t site : sites) lines += targets_in_reach(survey_.positions[site]);
    task.seconds = effort_of_triangles(task.points) +
                   (survey_.targets.grid ? effort_of_swept_lines(lines) : effort_of_lines(lines));
    return task;
  }

  /// About how many there are.
  double targets_in_reach(const SitePosition& site) const {
    const SiteTargets& targets = survey_.targets;
    if (!targets.grid) return static_cast<double>(within_reach(targets, site.position, survey_.radius).size());
    return std::min(std::numbers::pi * survey_.radius * survey_.radius / targets.grid->cell_area(),
                    static_cast<double>(targets.grid->cell_count()));
  }

  /// The number of blocks that sets of cells or points have.
  std::size_t blocks() const {
    const SiteTargets& targets = survey_.targets;
    return ((targets.grid ? element_count(*targets.grid) : targets.points.size()) + 63) / 64;
  }

  const Store& store_;
  ProgressNow progress_;
  SitePlanner planner_;
  const SiteSurvey survey_;
  std::vector<std::size_t> order_;  ///< neighbours are next to each other
  std::vector<Task> list_;
  std::vector<double> heights_m_;  ///< one for each option, as far as they were added
  std::mutex mutex_;
  std::optional<SiteCoverage> coverage_;
};

SiteTasks::SiteTasks(const Store& store, SitePlanRequest request, std::uint64_t most_sites, Progress& progress)
    : impl_(std::make_unique<Impl>(store, std::move(request), most_sites, progress)) {}
SiteTasks::~SiteTasks() = default;

const std::vector<Task>& SiteTasks::list() const {
  return impl_->list();
}
std::string SiteTasks::answer(std::size_t task, Progress& progress) const {
  return impl_->answer(task, progress);
}
void SiteTasks::add(std::size_t task, std::string_view answer) {
  impl_->add(task, answer);
}
SitePlan SiteTasks::take(Progress& progress) {
  return impl_->take(progress);
}

}  // namespace itin::viewshed
