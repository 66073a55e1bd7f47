// One handle for progress and cancellation, passed down to every long call.
#pragma once

#include <string_view>

#include <itin/error.hpp>

namespace itin {

/// Derive to show progress or to stop a call. Both functions are called from any thread, possibly at the same time.
class Progress {
 public:
  virtual ~Progress() = default;
  /// `fraction` of the stage called `stage` is done, 0 to 1.
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

}  // namespace itin
