// Finds the samples around points, one batch of points after another: the latest sample of each bucket around a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "store/codec/bucket_grid.hpp"
#include "store/codec/prediction_plane.hpp"

namespace itin {

inline constexpr std::size_t kSamplesAround = kBucketsAround.size();
/// The weights of samples' heights in the prediction, by number of kBucketsAround; 0 for a bucket without a sample.
using Shares = std::array<double, kSamplesAround>;

inline constexpr std::size_t kPointsOfBatch = 32;
template <class T>
using OfBatch = std::array<T, kPointsOfBatch>;

/// The points that come next, and their buckets.
struct NextPoints {
  std::span<const LocalPosition> points;
  OfBatch<std::size_t> buckets;
};

/// The sample in one of the buckets around a point.
struct SampleAround {
  bool there = false;
  std::int32_t dx = 0, dy = 0;  ///< from the point, in steps whose number stays below 26
};

// Both classes refer to the buckets, which hold no samples at first.

/// The samples where buckets are single positions.
class LatticeSamples {
 public:
  explicit LatticeSamples(const BucketGrid& buckets) : buckets_(&buckets), around_(buckets.count()) {}

  /// Finds the shares of the samples around each point before the point becomes its bucket's sample. They are null
  /// where no sample is around, else valid until the next call.
  void find_shares_around(const NextPoints& batch, OfBatch<const Shares*>& shares);
  /// Returns the sample in the i-th of kBucketsAround, for the latest batch's point j.
  SampleAround sample(std::size_t j, std::size_t i) const {
    return {(there_[j] >> i & 1) != 0, kBucketsAround[i].x, kBucketsAround[i].y};
  }

 private:
  const BucketGrid* buckets_;
  std::vector<std::uint8_t> around_;  // by bucket: the buckets around it that have a sample, as bits
  OfBatch<std::uint8_t> there_{};     // around_ of each point's bucket
};

/// The samples where buckets are wider.
class ScatteredSamples {
 public:
  explicit ScatteredSamples(const BucketGrid& buckets);

  /// Finds shares as LatticeSamples does.
  void find_shares_around(const NextPoints& batch, OfBatch<const Shares*>& shares);
  SampleAround sample(std::size_t j, std::size_t i) const {
    return {sample_x_[i][j] != kNone, (sample_x_[i][j] - x_[j]) >> offset_shift_,
            (sample_y_[i][j] - y_[j]) >> offset_shift_};
  }

 private:
  static constexpr std::int32_t kNone = -1;
  struct Position {
    std::int32_t x = kNone, y = kNone;
  };
  // Finds the shares of four points from `first` on.
  void find_shares(std::size_t first, OfBatch<const Shares*>& shares);

  const BucketGrid* buckets_;
  int offset_shift_;               // makes differences of positions less than 26
  std::vector<Position> samples_;  // by bucket
  OfBatch<std::int32_t> x_{}, y_{};
  std::array<OfBatch<std::int32_t>, kSamplesAround> sample_x_{}, sample_y_{};  // kNone where there is none
  OfBatch<Shares> shares_{};
};

using SamplesAround = std::variant<LatticeSamples, ScatteredSamples>;
inline SamplesAround samples_around(const BucketGrid& buckets) {
  if (buckets.shift() == 0) return SamplesAround(std::in_place_type<LatticeSamples>, buckets);
  return SamplesAround(std::in_place_type<ScatteredSamples>, buckets);
}

}  // namespace itin
