// Predicts the heights of a block's points, each from those before it.
//
// What a sample's height counts for depends on positions alone, so that is found for many points at once. A prediction
// then takes one sum of products, which is good to far less than a thousandth of a step. Where a thousandth could make
// it another whole number, FORMAT.md's own arithmetic decides, whose operations wait for each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "store/prediction_plane.hpp"

namespace itin {

/// A position within a block: on the block's lattice where there is one, else in grid units.
struct LocalPosition {
  std::uint32_t x, y;
};

class HeightPredictor {
 public:
  /// `positions` of at least one point, in the order of coding.
  explicit HeightPredictor(std::vector<LocalPosition> positions);

  /// The next point's height. Precondition: at least one was added.
  std::int64_t predict() const;
  /// The next point's height; |z| <= 2^33.
  void add(std::int64_t z);

 private:
  static constexpr std::size_t kSamples = kBucketsAround.size();
  static constexpr std::size_t kBatch = 32;
  template <class T>
  using OfBatch = std::array<T, kBatch>;
  using Shares = std::array<double, kSamples>;
  static constexpr std::int32_t kNone = -1;
  struct Spot {
    std::int32_t x = kNone, y = kNone;
  };

  // Whether buckets are single positions, which tell where their samples are.
  bool on_lattice() const { return shift_ == 0; }
  void begin_batch();
  void look_around_on_lattice(std::size_t count);
  void look_around(std::size_t count);
  void find_shares(std::size_t count);
  template <class Visit>
  void for_each_sample(const Visit& visit) const;
  // By FORMAT.md's own arithmetic.
  std::int64_t predict_slowly() const;

  std::vector<LocalPosition> positions_;  // from the corner of their extent
  std::size_t next_ = 0;
  std::int64_t last_ = 0;  // the latest height
  bool moderate_ = true;   // all heights so far
  int shift_ = 0;          // log2 of a bucket's side
  int offset_shift_ = 0;   // brings differences of positions below 32
  std::size_t stride_ = 0;
  std::array<std::ptrdiff_t, kSamples> around_{};  // kBucketsAround, by number
  // By bucket, of its latest sample:
  std::vector<double> heights_;        // 0 where there is none
  std::vector<Spot> spots_;            // empty on a lattice
  std::vector<std::uint8_t> samples_;  // on a lattice: which of the buckets around have one, as bits

  // By point of a batch, with the buckets as they are before it comes:
  OfBatch<std::size_t> bucket_{};
  OfBatch<std::int32_t> x_{}, y_{};
  OfBatch<std::uint8_t> there_{};                                        // on a lattice: as samples_
  std::array<OfBatch<std::int32_t>, kSamples> sample_x_{}, sample_y_{};  // else; kNone where there is no sample
  OfBatch<Shares> shares_{};                                             // else; 0 where there is no sample
  OfBatch<bool> alone_{};                                                // whether no sample is around
};

}  // namespace itin
