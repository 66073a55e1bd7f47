// About the median of the last few numbers: five numbers in order, of which by turns the highest and the lowest make
// room for a new one.
#pragma once

#include <array>
#include <cstdint>

namespace itin {

class RunningMedian {
 public:
  std::int32_t get() const { return sorted_[2]; }

  void add(std::int32_t number) {
    const std::int32_t median = sorted_[2];
    if (highest_goes_) {
      std::size_t place = 4;
      for (; place > 0 && number < sorted_[place - 1]; --place) sorted_[place] = sorted_[place - 1];
      sorted_[place] = number;
      highest_goes_ = number < median;
    } else {
      std::size_t place = 0;
      for (; place < 4 && sorted_[place + 1] < number; ++place) sorted_[place] = sorted_[place + 1];
      sorted_[place] = number;
      highest_goes_ = number <= median;
    }
  }

 private:
  std::array<std::int32_t, 5> sorted_{};
  bool highest_goes_ = true;
};

}  // namespace itin
