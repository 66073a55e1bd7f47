// One handle for progress and cancellation, passed down to every long call; and the number of threads such calls use.
//
//   struct Bar final : Progress {
//     std::atomic<bool> stop = false;  // set it from any thread: the call throws Cancelled
//     void report(std::string_view stage, double fraction) override {
//       std::cerr << stage << ' ' << static_cast<int>(100 * fraction) << " %\n";
//     }
//     bool cancelled() const override { return stop; }
//   } bar;
//   const Tin tin = triangulate(store, Window::all(), Detail::tolerance(8), bar);
#pragma once

#include <memory>
#include <string_view>

#include <itin/error.hpp>

namespace itin {

/// Derive to show progress or to stop a call. Both functions are called from any thread, possibly at the same time.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Reports that `fraction` of the call is done: it never decreases, and ends at 1. `stage` is what the call is doing.
  virtual void report(std::string_view stage, double fraction) = 0;
  /// True makes the running call throw Cancelled at its next opportunity.
  virtual bool cancelled() const { return false; }

  void throw_if_cancelled() const {
    if (cancelled()) throw Cancelled();
  }
};

/// Shows nothing and never stops.
class NoProgress final : public Progress {
 public:
  void report(std::string_view, double) override {}
};

/// Limits all calls of the process together to this many threads; 0 means all cores. No result depends on it.
void set_thread_count(int threads);
/// Returns how many threads calls of this thread may use now, at least 1.
int thread_count();

/// Limits the calls of one thread, for as long as the ThreadLimit lives, to this many threads, the calling one among
/// them; calls of other threads keep their own limits. One thread must make and destroy it, the last one made first. No
/// result depends on it.
///
///   const ThreadLimit two(2);
///   const auto result = viewshed::compute(store, request, progress);
class ThreadLimit {
 public:
  /// Throws InputError for fewer than 1 thread.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
