#include "serve/live/latest_work.hpp"

#include <algorithm>
#include <utility>

namespace itin::cli {

namespace {

/// Newer work does not wait for longer than this, whether or not anything was shown.
constexpr std::chrono::seconds kLongestToShow{3};

}  // namespace

bool LatestWork::Run::cancelled() const {
  return dropped_ || (superseded_ && (shown_ || Clock::now() - begun_ > kLongestToShow));
}

LatestWork::LatestWork() : thread_([this] { work(); }) {}

LatestWork::~LatestWork() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    waiting_.clear();
    if (running_ != nullptr) running_->dropped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LatestWork::put(std::uint32_t key, Work work) {
  {
    const std::lock_guard lock(mutex_);
    if (running_ != nullptr && running_->key_ == key) running_->superseded_ = true;
    const auto same =
        std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) { return waiting.key == key; });
    if (same != waiting_.end())
      same->work = std::move(work);
    else
      waiting_.push_back({key, std::move(work)});
  }
  changed_.notify_all();
}

void LatestWork::drop(std::uint32_t key) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const Waiting& waiting) { return waiting.key == key; });
  if (running_ != nullptr && running_->key_ == key) running_->dropped_ = true;
}

void LatestWork::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    Run run;
    run.key_ = next.key;
    running_ = &run;
    lock.unlock();
    try {
      next.work(run);
    } catch (const Cancelled&) {
      // Nobody waits for the rest.
    }
    lock.lock();
    running_ = nullptr;
  }
}

}  // namespace itin::cli
