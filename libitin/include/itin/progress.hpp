// One handle for progress and cancellation, passed down to every long call; and how many threads such calls use.
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
  /// `fraction` of the call is done: it never decreases, and ends at 1. `stage` is what the call is doing.
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

/// Limits all calls of the process to this many threads in all; 0 means all cores. No result depends on it.
void set_thread_count(int threads);
/// How many threads calls of this thread may use now, at least 1.
int thread_count();

/// Limits the calls of one thread for as long as it lives, the thread itself among them; those of other threads keep
/// their own limits. To be made and destroyed by the thread, the last one first. No result depends on it.
///
///   const ThreadLimit two(2);
///   const auto result = viewshed::compute(store, request, progress);
class ThreadLimit {
 public:
  /// At least 1. Throws InputError for less.
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
