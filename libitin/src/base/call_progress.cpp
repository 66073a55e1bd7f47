#include <algorithm>
#include <utility>

#include <itin/call_progress.hpp>

namespace itin {

Progress& CallProgress::step(double share) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(stepped_, true)) begin_ = end_;
  end_ = share < 1 ? begin_ + share * (1 - begin_) : 1;
  return *this;
}

void CallProgress::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  report_whole(stage, fraction < 1 ? begin_ + std::max(fraction, 0.0) * (end_ - begin_) : end_);
}

void CallProgress::finish() {
  const std::lock_guard lock(mutex_);
  if (reported_ < 1) report_whole(stage_.empty() ? "done" : std::string(stage_), 1);
}

/// Reports the fraction of the whole call. A stage that begins anew stays at the fraction that the call has reached.
void CallProgress::report_whole(std::string_view stage, double fraction) {
  if (fraction <= reported_ && stage == stage_) return;
  reported_ = std::max(reported_, fraction);
  stage_ = stage;
  whole_.report(stage_, reported_);
}

}  // namespace itin
