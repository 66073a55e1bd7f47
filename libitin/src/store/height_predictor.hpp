// Predicts the height of a block's next point from those before it: a weighted least-squares plane through the latest
// points of the surrounding buckets, with the slope damped.
//
// Encoder and decoder must come to the same number to the last bit on every machine. All sums are integers that
// binary64 holds exactly; the operations after them are IEEE 754, each rounded to nearest (never compile with
// contraction or fast-math). FORMAT.md repeats this arithmetic.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itin {

class HeightPredictor {
 public:
  /// Local positions lie in [0, width) x [0, height); `count` of them will come.
  HeightPredictor(std::uint32_t width, std::uint32_t height, std::size_t count);

  /// Precondition: at least one point was added.
  std::int64_t predict(std::uint32_t x, std::uint32_t y) const;
  /// |z| <= 2^33
  void add(std::uint32_t x, std::uint32_t y, std::int64_t z);

 private:
  struct Sample {
    std::uint32_t x, y;
    std::int64_t z;
  };
  std::size_t bucket(std::uint32_t x, std::uint32_t y) const {
    return ((y >> shift_) + kMargin) * stride_ + (x >> shift_) + kMargin;
  }

  // Where buckets are single positions, their heights are all that is kept.
  bool on_lattice() const { return shift_ == 0; }

  // A bucket's latest sample; null where it has none.
  const Sample* latest(std::size_t bucket) const {
    const std::uint16_t number = latest_[bucket];
    return number == 0 ? nullptr : &samples_[number - 1U];
  }
  std::int64_t above_last(std::int64_t z) const { return std::clamp(z - last_, -kHeightLimit, kHeightLimit); }
  // Above the last sample's height; 0 where no sample is near.
  double offset_on_lattice(std::uint32_t x, std::uint32_t y) const;
  double offset_among(std::uint32_t x, std::uint32_t y) const;

  static constexpr std::int64_t kHeightLimit = std::int64_t{1} << 20;  ///< keeps every sum below 2^53
  static constexpr std::int64_t kNoHeight = std::numeric_limits<std::int64_t>::min();
  static constexpr std::size_t kMargin = 2;
  int shift_ = 0;         ///< log2 of a bucket's side
  int offset_shift_ = 0;  ///< brings differences of positions below 32
  std::size_t stride_ = 0;
  std::int64_t last_ = 0;  ///< height of the latest sample
  std::vector<Sample> samples_;
  std::vector<std::uint16_t> latest_;  ///< by bucket: index of its latest sample plus 1, or 0
  std::vector<std::int64_t> heights_;  ///< on a lattice, by bucket; kNoHeight where none has come
};

}  // namespace itin
