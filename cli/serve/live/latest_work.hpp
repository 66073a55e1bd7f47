// A thread that works for one client, for whom the latest counts: work that waits is replaced by newer work of the same
// key, and work that runs makes room for it.
//
//   LatestWork work;
//   work.put(1, [](LatestWork::Run& run) { draw(run); });
//   work.put(1, [](LatestWork::Run& run) { draw_from_elsewhere(run); });  // the first is not begun any more, or ends
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <thread>

#include <itin/progress.hpp>

namespace itin::cli {

/// Safe for concurrent use.
class LatestWork {
 public:
  /// Says when work is to end: at once where its key was dropped, and where newer work waits, once it has shown
  /// something. Were it to end before, nothing would be shown while a hand moves on and on.
  class Run final : public Progress {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override;
    /// To be called by the work when it has shown enough.
    void note_shown() { shown_ = true; }

   private:
    friend class LatestWork;
    using Clock = std::chrono::steady_clock;

    std::uint32_t key_ = 0;
    Clock::time_point begun_ = Clock::now();
    std::atomic<bool> dropped_{false}, superseded_{false}, shown_{false};
  };
  /// May throw Cancelled, and nothing else.
  using Work = std::function<void(Run&)>;

  LatestWork();
  /// Drops all work, and waits for what runs.
  ~LatestWork();
  LatestWork(const LatestWork&) = delete;
  LatestWork& operator=(const LatestWork&) = delete;

  void put(std::uint32_t key, Work work);
  void drop(std::uint32_t key);

 private:
  struct Waiting {
    std::uint32_t key;
    Work work;
  };

  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Waiting> waiting_;  ///< in the order in which their keys came
  Run* running_ = nullptr;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace itin::cli
