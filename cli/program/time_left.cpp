#include "program/time_left.hpp"

#include <cmath>

#include <fmt/format.h>

namespace itin::cli {

namespace {

/// Limits below which it is too early to estimate: the first twentieth of a call may run many times faster or slower
/// than the rest.
constexpr double kLeastDone = 0.05;
constexpr std::chrono::seconds kLeastTime{2};

}  // namespace

std::optional<std::chrono::seconds> TimeLeft::after(double fraction, Clock::time_point now) {
  if (!call_ || fraction < call_->last) call_ = Call{now, fraction, fraction};
  call_->last = fraction;
  const double done = fraction - call_->first;
  const std::chrono::duration<double> taken = now - call_->begun;
  if (done < kLeastDone || taken < kLeastTime || fraction >= 1) return std::nullopt;
  return std::chrono::seconds(std::llround(taken.count() * (1 - fraction) / done));
}

std::string about(std::chrono::seconds duration) {
  const long long seconds = duration.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  const long long minutes = (seconds + 30) / 60;
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60 / 10 * 10);
}

}  // namespace itin::cli
