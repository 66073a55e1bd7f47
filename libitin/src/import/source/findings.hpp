// Warnings about single features of a source. A city has thousands of odd footprints, and the first ones show what is
// wrong.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace itin {

class Findings {
 public:
  /// Each line begins with `place`: a file or a theme.
  explicit Findings(std::string place) : place_(std::move(place)) {}

  void add(const std::string& finding) {
    if (++count_ <= kMost) lines_.push_back(place_ + ": " + finding);
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> lines = lines_;
    if (count_ > kMost) lines.push_back(fmt::format("{}: {} more like these", place_, count_ - kMost));
    return lines;
  }

 private:
  static constexpr std::size_t kMost = 20;
  std::string place_;
  std::size_t count_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace itin
