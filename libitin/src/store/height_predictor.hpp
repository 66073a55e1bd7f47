// Predicts the heights of a block's points, each from those before it.
//
// What a sample's height counts for depends on positions alone, so that is found for many points at once. A prediction
// then takes one sum of products, which is good to far less than a thousandth of a step. Where a thousandth could make
// it another whole number, FORMAT.md's own arithmetic decides, whose operations wait for each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "store/bucket_grid.hpp"
#include "store/samples_around.hpp"

namespace itin {

class HeightPredictor {
 public:
  /// `positions` of at least one point, in the order of coding.
  explicit HeightPredictor(std::vector<LocalPosition> positions);
  HeightPredictor(const HeightPredictor&) = delete;
  HeightPredictor& operator=(const HeightPredictor&) = delete;

  /// The next point's height. Precondition: at least one was added.
  std::int64_t predict() const;
  /// The next point's height; |z| <= 2^33.
  void add(std::int64_t z);

 private:
  void begin_batch();
  // By FORMAT.md's own arithmetic.
  std::int64_t predict_slowly() const;

  std::vector<LocalPosition> positions_;  // from the corner of their extent
  BucketGrid buckets_;
  std::vector<double> heights_;  // by bucket: of its sample, 0 where it has none
  SamplesAround samples_;
  std::size_t next_ = 0;   // the point that comes
  std::int64_t last_ = 0;  // the latest height
  bool moderate_ = true;   // all heights so far
  PointBatch batch_;
  OfBatch<const Shares*> shares_{};
};

}  // namespace itin
