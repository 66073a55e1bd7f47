#include "progress/stage.hpp"

#include <algorithm>
#include <atomic>

#include <itin/parallel.hpp>

namespace itin::viewshed {

Stage::Stage(std::string_view name, std::size_t steps, Progress& progress)
    : name_(name), steps_(steps), progress_(progress) {
  report();
}

void Stage::advance(std::size_t steps) {
  const std::lock_guard lock(mutex_);
  done_ += steps;
  report();
}

void Stage::advance_to(std::size_t step) {
  const std::lock_guard lock(mutex_);
  done_ = std::max(done_, step);
  report();
}

void Stage::for_each(std::size_t count, const std::function<std::size_t(std::size_t)>& body) {
  parallel_for(count, [&](std::size_t i) { take(i, body); });
}

void Stage::for_each_in_order(std::size_t count, const std::function<std::size_t(std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  const auto take_steps = [&](std::size_t) {
    try {
      for (std::size_t i = next++; i < count; i = next++) take(i, body);
    } catch (...) {
      next = count;  // the other threads end, too
      throw;
    }
  };
  parallel_for(std::min(count, static_cast<std::size_t>(thread_count())), take_steps);
}

void Stage::take(std::size_t i, const std::function<std::size_t(std::size_t)>& body) {
  progress_.throw_if_cancelled();
  advance(body(i));
}

/// Must run within the lock: else a thread could report what another has long passed.
void Stage::report() {
  const double share = steps_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(steps_);
  const int thousandths = static_cast<int>(1000 * share);
  if (thousandths <= reported_) return;
  reported_ = thousandths;
  progress_.report(name_, share);
}

void for_each_step(std::size_t count, std::string_view stage, Progress& progress,
                   const std::function<void(std::size_t)>& body) {
  Stage(stage, count, progress).for_each(count, [&](std::size_t i) {
    body(i);
    return std::size_t{1};
  });
}

}  // namespace itin::viewshed
