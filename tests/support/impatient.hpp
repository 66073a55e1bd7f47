// Progress that is cancelled.
#pragma once

#include <atomic>
#include <string_view>

#include <itin/progress.hpp>

namespace itin::test {

/// Cancels a call once it has asked more than `looks` times whether it is cancelled.
class Impatient final : public Progress {
 public:
  explicit Impatient(int looks) : looks_(looks) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return ++asked_ > looks_; }
  int asked() const { return asked_; }

 private:
  int looks_;
  mutable std::atomic<int> asked_ = 0;
};

}  // namespace itin::test
