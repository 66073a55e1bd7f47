#include "stderr_progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

#include "interruption.hpp"

namespace itin::cli {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRedraw{100};
constexpr milliseconds kPlainLine{3000};
/// No guess at the time left before this much of a stage has passed: the first would be far off.
constexpr milliseconds kFirstGuess{500};

std::string duration(double seconds) {
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

StderrProgress::Style StderrProgress::style_for(bool quiet) {
  if (quiet) return Style::kSilent;
  return isatty(STDERR_FILENO) != 0 ? Style::kTerminal : Style::kLines;
}

StderrProgress::StderrProgress(Style style) : style_(style), stage_start_(Clock::now()), last_drawn_(stage_start_) {}

StderrProgress::~StderrProgress() {
  clear();
}

std::string StderrProgress::line(double fraction, Clock::time_point now) const {
  std::string text = fmt::format("{} {:3.0f} %", stage_, std::floor(100 * fraction));
  const std::chrono::duration<double> elapsed = now - stage_start_;
  if (elapsed >= kFirstGuess && fraction > 0 && fraction < 1) {
    text += fmt::format(", {} left", duration(elapsed.count() * (1 - fraction) / fraction));
  }
  return text;
}

void StderrProgress::report(std::string_view stage, double fraction) {
  if (style_ == Style::kSilent) return;
  // Workers must not queue up here: whoever finds the line busy has nothing urgent to say.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (now - last_drawn_ < (style_ == Style::kTerminal ? kRedraw : kPlainLine)) return;
  last_drawn_ = now;
  const std::string text = line(std::clamp(fraction, 0.0, 1.0), now);
  if (style_ == Style::kTerminal) {
    fmt::print(stderr, "\r\x1b[K{}", text);
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
  drawn_ = true;
}

bool StderrProgress::cancelled() const {
  return interrupted();
}

void StderrProgress::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_ && style_ == Style::kTerminal) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace itin::cli
