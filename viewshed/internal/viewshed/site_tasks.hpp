// A choice of sites whose survey others make.
//
//   SiteTasks tasks(store, request, most_sites, progress);
//   ...                                                          // answered anywhere, and added
//   const SitePlan plan = tasks.take(progress);                  // that of plan_sites(), to the last bit
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <viewshed/site_plan.hpp>
#include <viewshed/tasks.hpp>

namespace itin::viewshed {

/// The tasks are groups of neighbouring sites, and what the first look at each tells; where heights of turbines are
/// summed, these sums. What the choice asks about few sites is left to take(): closer looks, links, rasters.
class SiteTasks final : public Tasks {
 public:
  /// The store must outlive it. Finds candidates and demand, as everyone who answers a task has to. Throws as
  /// plan_sites() does.
  SiteTasks(const Store& store, SitePlanRequest request, std::uint64_t most_sites, Progress& progress);
  ~SiteTasks() override;

  const std::vector<Task>& list() const override;
  std::string answer(std::size_t task, Progress& progress) const override;
  void add(std::size_t task, std::string_view answer) override;
  /// Makes the plan. To be called once. Precondition: all answers were added.
  SitePlan take(Progress& progress);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
