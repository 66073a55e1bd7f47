// A stage of a long call: how far it has come, and its loops on all threads.
//
//   for_each_step(tiles.cell_count(), "sight lines", progress, [&](std::size_t tile) { ... });
//
//   Stage stage("sight lines", observers * cells, progress);                // shared by several loops
//   stage.for_each(tiles.size(), [&](std::size_t i) { ...; return cells_in(tiles[i]); });
//   stage.advance_to(cells);
//
// The reported fraction only grows, whatever threads do, and reaches 1 with the last step.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include <itin/progress.hpp>

namespace itin::viewshed {

class Stage {
 public:
  /// The stage has `steps` steps. `progress` must outlive it.
  Stage(std::string_view name, std::size_t steps, Progress& progress);

  /// Adds `steps` finished steps; `advance_to` sets their total. Both may be called from any thread.
  void advance(std::size_t steps);
  void advance_to(std::size_t step);

  /// Runs body(i) for i in [0, count) on all threads; body returns how many steps it has made. Throws Cancelled.
  void for_each(std::size_t count, const std::function<std::size_t(std::size_t)>& body);
  /// Does so, but begins them in their order. A thread then meets fewer neighbours one after the other, which costs up
  /// to a tenth of the time where these share what they read.
  void for_each_in_order(std::size_t count, const std::function<std::size_t(std::size_t)>& body);

 private:
  void take(std::size_t i, const std::function<std::size_t(std::size_t)>& body);
  void report();

  const std::string name_;
  const std::size_t steps_;
  Progress& progress_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  int reported_ = -1;  ///< thousandths
};

/// Runs body(i) for i in [0, count) on all threads, as a stage of `count` steps. Throws Cancelled.
void for_each_step(std::size_t count, std::string_view stage, Progress& progress,
                   const std::function<void(std::size_t)>& body);

}  // namespace itin::viewshed
