// Where labels of a drawing may stand without one covering another.
#pragma once

#include <algorithm>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

class LabelPlaces {
 public:
  /// Nothing may stand there any more.
  void take(const Box& box) { taken_.push_back(box); }
  bool free(const Box& box) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Box& t) {
      return t.xmin < box.xmax && box.xmin < t.xmax && t.ymin < box.ymax && box.ymin < t.ymax;
    });
  }

 private:
  std::vector<Box> taken_;
};

}  // namespace itin
