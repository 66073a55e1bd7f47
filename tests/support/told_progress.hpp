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
  }

  const std::vector<double>& of(const std::string& stage) { return told_[stage]; }

  /// Only grows, and ends at 1.
  void expect_whole(const std::string& stage) {
    const std::vector<double>& told = of(stage);
    ASSERT_FALSE(told.empty()) << stage;
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end())) << stage;
    EXPECT_EQ(told.back(), 1) << stage;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::vector<double>> told_;
};

}  // namespace itin::test
