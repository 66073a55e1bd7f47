#include "program/time_left.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace itin::cli {

namespace {

/// Less of a stage tells nothing: it may go twenty times as fast as the rest, or slower.
constexpr double kLeastDone = 0.05;
constexpr std::chrono::seconds kLeastTime{2};
/// Workers report out of order; what falls back farther has begun anew.
constexpr double kOutOfOrder = 0.05;

}  // namespace

std::optional<std::chrono::seconds> TimeLeft::after(std::string_view name, double fraction, Clock::time_point now) {
  auto found = stages_.find(name);
  if (found == stages_.end() || fraction < found->second.most - kOutOfOrder)
    found = stages_.insert_or_assign(std::string(name), Stage{now, fraction, fraction}).first;
  Stage& stage = found->second;
  stage.most = std::max(stage.most, fraction);
  const double done = stage.most - stage.first;
  const std::chrono::duration<double> taken = now - stage.begun;
  if (done < kLeastDone || taken < kLeastTime || stage.most >= 1) return std::nullopt;
  return std::chrono::seconds(std::llround(taken.count() * (1 - stage.most) / done));
}

std::string about(std::chrono::seconds duration) {
  const long long seconds = duration.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  const long long minutes = (seconds + 30) / 60;
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60 / 10 * 10);
}

}  // namespace itin::cli
