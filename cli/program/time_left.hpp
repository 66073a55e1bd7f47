// Estimates how long a call will go on, from how it has gone so far.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace itin::cli {

class TimeLeft {
 public:
  using Clock = std::chrono::steady_clock;

  /// Returns the time left for a call of which `fraction` is done `now`; nothing until enough is done to tell. A
  /// fraction that falls back begins another call.
  std::optional<std::chrono::seconds> after(double fraction, Clock::time_point now);

 private:
  struct Call {
    Clock::time_point begun;
    double first = 0;  ///< the fraction at that time
    double last = 0;
  };
  std::optional<Call> call_;
};

/// Writes a duration: "12 s", "3 min", "1 h 20 min". It is no more precise than the estimate.
std::string about(std::chrono::seconds duration);

}  // namespace itin::cli
