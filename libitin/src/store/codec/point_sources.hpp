// The source of each of a block's points. Most blocks have one source, which is kept once.
//
//   PointSources sources;
//   sources.add(0, 1024);
//   sources[17]           // 0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itin {

class PointSources {
 public:
  std::size_t size() const { return size_; }
  std::uint16_t operator[](std::size_t k) const { return of_each_.empty() ? of_all_ : of_each_[k]; }
  /// Tells whether all points have the same source.
  bool are_one() const { return of_each_.empty(); }
  /// Adds the source of the next points.
  void add(std::uint16_t source, std::size_t points = 1) {
    if (size_ == 0) of_all_ = source;
    if (of_each_.empty() && source != of_all_) of_each_.assign(size_, of_all_);
    size_ += points;
    if (!of_each_.empty()) of_each_.resize(size_, source);
  }
  /// Returns the memory it takes besides the object itself.
  std::size_t bytes() const { return of_each_.capacity() * sizeof(std::uint16_t); }

 private:
  std::size_t size_ = 0;
  std::uint16_t of_all_ = 0;
  std::vector<std::uint16_t> of_each_;  ///< empty where all are of_all_
};

}  // namespace itin
