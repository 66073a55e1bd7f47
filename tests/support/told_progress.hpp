// Keeps what a call reports of its progress.
#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <itin/progress.hpp>

namespace itin::test {

class ToldProgress final : public Progress {
 public:
  void report(std::string_view stage, double fraction) override {
    const std::lock_guard lock(mutex_);
    told_[std::string(stage)].push_back(fraction);
    all_.push_back(fraction);
  }

  /// All fractions reported, whatever the stage.
  const std::vector<double>& all() const { return all_; }

  const std::vector<double>& of(const std::string& stage) { return told_[stage]; }

  /// Expects that the call's fraction only grows, and ends at 1.
  void expect_whole_call() const {
    ASSERT_FALSE(all_.empty());
    EXPECT_GE(all_.front(), 0);
    EXPECT_TRUE(std::is_sorted(all_.begin(), all_.end()));
    EXPECT_EQ(all_.back(), 1);
  }
  /// Expects that the call's fraction grows in steps of at most `most`.
  void expect_steps_up_to(double most) const {
    double last = 0;
    for (const double fraction : all_) {
      EXPECT_LE(fraction - last, most) << "after " << last;
      last = fraction;
    }
  }

  /// Expects that the stage's fraction only grows, and ends at 1.
  void expect_whole(const std::string& stage) {
    const std::vector<double>& told = of(stage);
    ASSERT_FALSE(told.empty()) << stage;
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end())) << stage;
    EXPECT_EQ(told.back(), 1) << stage;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::vector<double>> told_;
  std::vector<double> all_;
};

}  // namespace itin::test
