#include <itin/beside.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>

#ifdef ITIN_PARALLEL
#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/stoppable.hpp"
#endif

namespace itin {

#ifdef ITIN_PARALLEL

namespace {

/// The arena of the ThreadLimit that this thread made, or that it works for; null where there is none.
thread_local tbb::task_arena* limited = nullptr;

/// Makes this thread work for an arena, for as long as the object lives.
class InArena {
 public:
  explicit InArena(tbb::task_arena* arena) : before_(std::exchange(limited, arena)) {}
  ~InArena() { limited = before_; }
  InArena(const InArena&) = delete;
  InArena& operator=(const InArena&) = delete;

 private:
  tbb::task_arena* before_;
};

std::mutex control_mutex;
std::unique_ptr<tbb::global_control> control;

#ifdef __SANITIZE_THREAD__

/// Runs a loop on threads of its own, for the thread sanitizer: oneTBB is not built with it, so that the sanitizer
/// would take what oneTBB orders for races. It sees the order of these threads.
void run_on_threads(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
      next = count;
    }
  };
  std::vector<std::jthread> others(std::min(count, static_cast<std::size_t>(thread_count())) - 1);
  for (std::jthread& thread : others) thread = std::jthread(work);
  work();
  others.clear();
  if (first) std::rethrow_exception(first);
}

#else

void run_on_threads(std::size_t count, const std::function<void(std::size_t)>& body) {
  // The context is isolated: an exception thrown elsewhere must not end a loop within another one, whose caller would
  // take it for finished.
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(std::size_t{0}, count, body, own);
}

#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (thread_count() == 1 || count == 0) {  // oneTBB would start a worker all the same, which the system may not allow
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  const Progress* const progress = stopper();
  const auto run = [&] {
    run_on_threads(count, [&, arena = limited](std::size_t i) {
      const Stoppable here(progress);
      const InArena working(arena);
      body(i);
    });
  };
  limited != nullptr ? limited->execute(run) : run();
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
  const auto all = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return limited != nullptr ? std::min(all, limited->max_concurrency()) : all;
}

bool has_thread_to_spare() {
  if (thread_count() == 1) return false;
  // oneTBB opens libraries of its own when it is first used. Only one library can be opened at a time. So oneTBB is
  // used now, lest it wait for one that the work beside it opens.
  run_on_threads(2, [](std::size_t) {});
  return true;
}

class ThreadLimit::Impl {
 public:
  explicit Impl(int threads) : arena_(threads), working_(&arena_) {}

 private:
  tbb::task_arena arena_;
  InArena working_;
};

#else

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

void set_thread_count(int) {}

int thread_count() {
  return 1;
}

bool has_thread_to_spare() {
  return false;
}

class ThreadLimit::Impl {};

#endif

ThreadLimit::ThreadLimit(int threads) {
  if (threads < 1) throw InputError("threads: give at least 1");
#ifdef ITIN_PARALLEL
  impl_ = std::make_unique<Impl>(std::min(threads, thread_count()));
#endif
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace itin
