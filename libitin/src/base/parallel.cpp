#include <itin/parallel.hpp>

#ifdef ITIN_PARALLEL
#include <memory>
#include <mutex>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/stoppable.hpp"
#endif

namespace itin {

#ifdef ITIN_PARALLEL

namespace {

std::mutex control_mutex;
std::unique_ptr<tbb::global_control> control;

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (thread_count() == 1) {  // oneTBB would start a worker all the same, which the system may not allow
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // Isolated: what is thrown elsewhere must not end a loop within another one, which its caller would take for
  // finished.
  tbb::task_group_context own(tbb::task_group_context::isolated);
  const Progress* const progress = stopper();
  const auto stoppable = [&](std::size_t i) {
    const Stoppable here(progress);
    body(i);
  };
  tbb::parallel_for(std::size_t{0}, count, stoppable, own);
}

void set_thread_count(int threads) {
  const std::lock_guard lock(control_mutex);
  control.reset();
  if (threads > 0) {
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
  }
}

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

#else

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

void set_thread_count(int) {}

int thread_count() {
  return 1;
}

#endif

}  // namespace itin
