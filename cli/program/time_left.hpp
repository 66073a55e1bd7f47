// How long a stage of work will go on, from how it has gone so far.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace itin::cli {

class TimeLeft {
 public:
  using Clock = std::chrono::steady_clock;

  /// The time left for a stage of which `fraction` is done `now`. Nothing until enough is done to tell. A stage that is
  /// left and entered again goes on where it was; one whose fraction falls back has begun anew.
  std::optional<std::chrono::seconds> after(std::string_view stage, double fraction, Clock::time_point now);

 private:
  struct Stage {
    Clock::time_point begun;
    double first = 0;  ///< the fraction then
    double most = 0;   ///< the greatest since
  };
  std::map<std::string, Stage, std::less<>> stages_;
};

/// "12 s", "3 min", "1 h 20 min": no finer than the estimate is good for.
std::string about(std::chrono::seconds duration);

}  // namespace itin::cli
