// Progress on stderr: one line redrawn in place on a terminal, a plain line every few seconds elsewhere, or lines of
// JSON for a program that reads them.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <itin/progress.hpp>

#include "program/time_left.hpp"

namespace itin::cli {

class StderrProgress final : public Progress {
 public:
  enum class Style { kSilent, kTerminal, kLines, kJson };

  /// kTerminal where stderr is a terminal, kLines elsewhere, kSilent if quiet.
  static Style style_for(bool quiet);

  explicit StderrProgress(Style style);
  ~StderrProgress() override;
  StderrProgress(const StderrProgress&) = delete;
  StderrProgress& operator=(const StderrProgress&) = delete;

  void report(std::string_view stage, double fraction) override;
  bool cancelled() const override;
  /// Wipes the line, so that the next output starts at its beginning. The destructor calls it, too.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line(std::string_view stage, double fraction, std::optional<std::chrono::seconds> left) const;

  const Style style_;
  std::mutex mutex_;
  TimeLeft left_;
  Clock::time_point last_drawn_;
  bool drawn_ = false;
};

}  // namespace itin::cli
