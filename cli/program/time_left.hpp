// How long a call will go on, from how it has gone so far.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace itin::cli {

class TimeLeft {
 public:
  using Clock = std::chrono::steady_clock;

  /// The time left for a call of which `fraction` is done `now`. Nothing until enough is done to tell. A fraction that
  /// falls back is another call's.
  std::optional<std::chrono::seconds> after(double fraction, Clock::time_point now);

 private:
  struct Call {
    Clock::time_point begun;
    double first = 0;  ///< the fraction then
    double last = 0;
  };
  std::optional<Call> call_;
};

/// "12 s", "3 min", "1 h 20 min": no finer than the estimate is good for.
std::string about(std::chrono::seconds duration);

}  // namespace itin::cli
