// Predicts the heights of a block's points, each from the points before it.
//
// The weight of a sample's height depends on positions alone, so weights are found for many points at once. A
// prediction then takes one sum of products, which is good to far less than a thousandth of a step. Where a thousandth
// could change its rounding, FORMAT.md's own arithmetic decides; its operations are slow, as each waits for the one
// before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "store/codec/bucket_grid.hpp"
#include "store/codec/samples_around.hpp"

namespace itin {

class HeightPredictor {
 public:
  /// Takes the positions of at least one point, in the order of coding.
  explicit HeightPredictor(std::vector<LocalPosition> positions);
  HeightPredictor(const HeightPredictor&) = delete;
  HeightPredictor& operator=(const HeightPredictor&) = delete;

  /// Predicts the next point's height. Precondition: at least one height was added.
  std::int64_t predict() const;
  /// Adds the next point's height. Precondition: |z| <= 2^33.
  void add(std::int64_t z);

 private:
  void begin_batch();
  // Predicts by FORMAT.md's own arithmetic.
  std::int64_t predict_slowly() const;

  std::vector<LocalPosition> positions_;  // counted from the corner of their extent
  BucketGrid buckets_;
  std::vector<double> heights_;  // height of each bucket's sample, 0 where it has none
  SamplesAround samples_;
  std::size_t next_ = 0;   // the next point
  std::int64_t last_ = 0;  // the latest height
  bool moderate_ = true;   // all heights so far are moderate
  NextPoints batch_;
  OfBatch<const Shares*> shares_{};
};

}  // namespace itin
