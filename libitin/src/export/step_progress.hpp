// Progress of a loop of many small steps.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>

namespace itin {

class StepProgress {
 public:
  StepProgress(Progress& progress, std::uint64_t steps) : progress_(progress), steps_(steps) {}
  /// Counts a step; every 65536 steps, reports and looks for cancellation.
  void step() {
    if ((++done_ & 0xffff) != 0) return;
    progress_.throw_if_cancelled();
    progress_.report("writing", static_cast<double>(done_) / static_cast<double>(steps_));
  }

 private:
  Progress& progress_;
  std::uint64_t steps_;
  std::uint64_t done_ = 0;
};

}  // namespace itin
