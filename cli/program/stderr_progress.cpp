#include "program/stderr_progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

#include <itin/document.hpp>

#include "program/interruption.hpp"

namespace itin::cli {

namespace {

using std::chrono::milliseconds;

/// The time between two lines, by style.
milliseconds interval_of(StderrProgress::Style style) {
  using enum StderrProgress::Style;
  return style == kTerminal ? milliseconds(100) : style == kJson ? milliseconds(200) : milliseconds(3000);
}

/// Writes so far as that is possible: a call does not depend on who reads its progress, or on the disk that keeps it.
void write_to_stderr(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

StderrProgress::Style StderrProgress::style_for(bool quiet) {
  if (quiet) return Style::kSilent;
  return isatty(STDERR_FILENO) != 0 ? Style::kTerminal : Style::kLines;
}

// A program that reads lines gets the first at once.
StderrProgress::StderrProgress(Style style)
    : style_(style), last_drawn_(Clock::now() - (style == Style::kJson ? interval_of(style) : milliseconds(0))) {}

StderrProgress::~StderrProgress() {
  clear();
}

void StderrProgress::report(std::string_view stage, double reported) {
  if (style_ == Style::kSilent) return;
  // Workers must not queue up here: a worker that finds the line busy has nothing urgent to say.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const auto now = Clock::now();
  const double fraction = std::clamp(reported, 0.0, 1.0);
  const auto left = left_.after(fraction, now);
  if (now - last_drawn_ < interval_of(style_)) return;
  last_drawn_ = now;
  write_to_stderr(line(stage, fraction, left));
  drawn_ = true;
}

std::string StderrProgress::line(std::string_view stage, double fraction,
                                 std::optional<std::chrono::seconds> left) const {
  if (style_ == Style::kJson) {
    Document document{{"stage", stage}, {"share", fraction}, {"seconds_left", nullptr}};
    if (left) document["seconds_left"] = left->count();
    return json_text(document) + "\n";
  }
  const std::string text = fmt::format("{} {:3.0f} %{}", stage, std::floor(100 * fraction),
                                       left ? fmt::format(", {} left", about(*left)) : "");
  return style_ == Style::kTerminal ? "\r\x1b[K" + text : text + "\n";
}

bool StderrProgress::cancelled() const {
  return interrupted();
}

void StderrProgress::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_ && style_ == Style::kTerminal) write_to_stderr("\r\x1b[K");
  drawn_ = false;
}

}  // namespace itin::cli
