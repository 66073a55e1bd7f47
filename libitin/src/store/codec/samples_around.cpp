#include "store/codec/samples_around.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace itin {

namespace {

// The shares of samples where buckets are single positions, indexed by the buckets that have a sample, as bits.
constexpr auto kSharesOnLattice = [] {
  std::array<Shares, std::size_t{1} << kSamplesAround> all{};
  for (std::size_t there = 1; there < all.size(); ++there) {
    PlaneMoments<double> moments;
    for (std::size_t i = 0; i < kSamplesAround; ++i) {
      const auto [x, y] = kBucketsAround[i];
      if ((there >> i & 1) != 0) moments.add(weight_at(x, y), x, y);
    }
    const SampleShares<double> shares{PredictionPlane<double>(moments)};
    for (std::size_t i = 0; i < kSamplesAround; ++i) {
      const auto [x, y] = kBucketsAround[i];
      if ((there >> i & 1) != 0) shares.find(all[there][i], weight_at(x, y), x, y);
    }
  }
  return all;
}();

// Vectors with one number for each of four points.
using Ints = std::int32_t __attribute__((vector_size(16)));
using Floats = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));
constexpr std::size_t kLanes = 4;

}  // namespace

void LatticeSamples::find_shares_around(const NextPoints& batch, OfBatch<const Shares*>& shares) {
  for (std::size_t j = 0; j < batch.points.size(); ++j) {
    std::uint8_t* const around = &around_[batch.buckets[j]];
    there_[j] = *around;
    shares[j] = there_[j] == 0 ? nullptr : &kSharesOnLattice[there_[j]];
    for (std::size_t i = 0; i < kSamplesAround; ++i) around[-buckets_->around(i)] |= static_cast<std::uint8_t>(1U << i);
  }
}

ScatteredSamples::ScatteredSamples(const BucketGrid& buckets)
    : buckets_(&buckets), offset_shift_(std::max(0, buckets.shift() - 3)), samples_(buckets.count()) {}

void ScatteredSamples::find_shares_around(const NextPoints& batch, OfBatch<const Shares*>& shares) {
  for (std::size_t j = 0; j < batch.points.size(); ++j) {
    Position* const samples = &samples_[batch.buckets[j]];
    for (std::size_t i = 0; i < kSamplesAround; ++i) {
      const Position sample = samples[buckets_->around(i)];
      sample_x_[i][j] = sample.x, sample_y_[i][j] = sample.y;
    }
    x_[j] = static_cast<std::int32_t>(batch.points[j].x), y_[j] = static_cast<std::int32_t>(batch.points[j].y);
    *samples = {x_[j], y_[j]};
  }
  for (std::size_t first = 0; first < batch.points.size(); first += kLanes) find_shares(first, shares);
}

void ScatteredSamples::find_shares(std::size_t first, OfBatch<const Shares*>& shares) {
  const auto lanes = [first](const OfBatch<std::int32_t>& values, Ints& four) {
    std::memcpy(&four, &values[first], sizeof four);
  };
  Ints x, y, sample_x, sample_y;
  lanes(x_, x), lanes(y_, y);
  std::array<Floats, kSamplesAround> dx, dy, weight;
  PlaneMoments<Floats> sums;
  for (std::size_t i = 0; i < kSamplesAround; ++i) {
    lanes(sample_x_[i], sample_x), lanes(sample_y_[i], sample_y);
    dx[i] = __builtin_convertvector((sample_x - x) >> offset_shift_, Floats);
    dy[i] = __builtin_convertvector((sample_y - y) >> offset_shift_, Floats);
    const Floats quotient = static_cast<float>(kGreatestWeight) / (dx[i] * dx[i] + dy[i] * dy[i] + 1);
    const Ints there = sample_x != kNone;
    weight[i] = __builtin_convertvector(__builtin_convertvector(quotient, Ints) & there, Floats);
    sums.add(weight[i], dx[i], dy[i]);
  }
  const auto widen = [](const Floats& from, Doubles& to) { to = __builtin_convertvector(from, Doubles); };
  PlaneMoments<Doubles> wide;
  widen(sums.w, wide.w), widen(sums.x, wide.x), widen(sums.y, wide.y);
  widen(sums.xx, wide.xx), widen(sums.xy, wide.xy), widen(sums.yy, wide.yy);
  const SampleShares<Doubles> found{PredictionPlane<Doubles>(wide)};
  for (std::size_t i = 0; i < kSamplesAround; ++i) {
    Doubles share, w, east, north;
    widen(weight[i], w), widen(dx[i], east), widen(dy[i], north);
    found.find(share, w, east, north);
    for (std::size_t k = 0; k < kLanes; ++k) shares_[first + k][i] = share[k];
  }
  for (std::size_t k = 0; k < kLanes; ++k) shares[first + k] = sums.w[k] == 0 ? nullptr : &shares_[first + k];
}

}  // namespace itin
