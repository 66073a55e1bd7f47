#include "store/height_predictor.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace itin {

namespace {

// Sums of products stay below 2^53 with differences of heights up to this one.
constexpr std::int64_t kGreatestDifference = std::int64_t{1} << 20;
// No difference of moderate heights is greater.
constexpr std::int64_t kModerateHeight = kGreatestDifference / 2;
// Offsets are below 36 steps and differ by whole ones, so that shares are found from numbers below 10^4, with errors
// below 10^-11. Those of eight moderate heights add up to less than 10^-4, and FORMAT.md's arithmetic has no greater
// error.
constexpr double kDoubt = 1e-3;

constexpr std::size_t kMargin = 2;  // of buckets, for those around

// One number for each of four points.
using Ints = std::int32_t __attribute__((vector_size(16)));
using Floats = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));
constexpr std::size_t kLanes = 4;

constexpr std::int32_t weight_of(std::int32_t dx, std::int32_t dy) {
  return kGreatestWeight / (dx * dx + dy * dy + 1);
}

// Where buckets are single positions: the share of each sample, by which of them are there, as bits.
constexpr auto kShares = [] {
  std::array<std::array<double, kBucketsAround.size()>, std::size_t{1} << kBucketsAround.size()> all{};
  for (std::size_t there = 1; there < all.size(); ++there) {
    PlaneMoments<double> moments;
    for (std::size_t i = 0; i < kBucketsAround.size(); ++i) {
      const auto [x, y] = kBucketsAround[i];
      if ((there >> i & 1) != 0) moments.add(weight_of(x, y), x, y);
    }
    const SampleShares<double> shares{PredictionPlane<double>(moments)};
    for (std::size_t i = 0; i < kBucketsAround.size(); ++i) {
      const auto [x, y] = kBucketsAround[i];
      if ((there >> i & 1) != 0) shares.find(all[there][i], weight_of(x, y), x, y);
    }
  }
  return all;
}();

// Moves positions to the corner of their extent; returns the greatest of both.
LocalPosition move_to_corner(std::vector<LocalPosition>& positions) {
  LocalPosition low = positions.front(), high = low;
  for (const LocalPosition& p : positions) {
    low.x = std::min(low.x, p.x), high.x = std::max(high.x, p.x);
    low.y = std::min(low.y, p.y), high.y = std::max(high.y, p.y);
  }
  for (LocalPosition& p : positions) p.x -= low.x, p.y -= low.y;
  return {high.x - low.x, high.y - low.y};
}

}  // namespace

HeightPredictor::HeightPredictor(std::vector<LocalPosition> positions) : positions_(std::move(positions)) {
  const LocalPosition greatest = move_to_corner(positions_);
  const auto buckets = [&](int shift) {
    return (std::uint64_t{greatest.x >> shift} + 1) * (std::uint64_t{greatest.y >> shift} + 1);
  };
  while (buckets(shift_) > 2 * positions_.size()) ++shift_;
  offset_shift_ = std::max(0, shift_ - 3);
  stride_ = (greatest.x >> shift_) + 1 + 2 * kMargin;
  const std::size_t all = stride_ * ((greatest.y >> shift_) + 1 + 2 * kMargin);
  for (std::size_t i = 0; i < kSamples; ++i)
    around_[i] = kBucketsAround[i].y * static_cast<std::ptrdiff_t>(stride_) + kBucketsAround[i].x;
  heights_.resize(all);
  if (on_lattice()) {
    samples_.resize(all);
  } else {
    spots_.resize(all);
  }
  begin_batch();
}

void HeightPredictor::begin_batch() {
  const std::size_t count = std::min(kBatch, positions_.size() - next_);
  for (std::size_t j = 0; j < count; ++j) {
    const LocalPosition& p = positions_[next_ + j];
    x_[j] = static_cast<std::int32_t>(p.x), y_[j] = static_cast<std::int32_t>(p.y);
    bucket_[j] = ((p.y >> shift_) + kMargin) * stride_ + (p.x >> shift_) + kMargin;
  }
  if (on_lattice()) {
    look_around_on_lattice(count);
  } else {
    look_around(count);
    find_shares(count);
  }
}

void HeightPredictor::look_around_on_lattice(std::size_t count) {
  for (std::size_t j = 0; j < count; ++j) {
    std::uint8_t* const samples = &samples_[bucket_[j]];
    there_[j] = *samples, alone_[j] = *samples == 0;
    for (std::size_t i = 0; i < kSamples; ++i) samples[-around_[i]] |= static_cast<std::uint8_t>(1U << i);
  }
}

void HeightPredictor::look_around(std::size_t count) {
  for (std::size_t j = 0; j < count; ++j) {
    Spot* const spots = &spots_[bucket_[j]];
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Spot spot = spots[around_[i]];
      sample_x_[i][j] = spot.x, sample_y_[i][j] = spot.y;
    }
    *spots = {x_[j], y_[j]};
  }
}

void HeightPredictor::find_shares(std::size_t count) {
  for (std::size_t first = 0; first < count; first += kLanes) {
    const auto lanes = [first](const OfBatch<std::int32_t>& values, Ints& four) {
      std::memcpy(&four, &values[first], sizeof four);
    };
    Ints x, y, sample_x, sample_y;
    lanes(x_, x), lanes(y_, y);
    std::array<Floats, kSamples> dx, dy, weight;
    PlaneMoments<Floats> sums;
    for (std::size_t i = 0; i < kSamples; ++i) {
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
    const SampleShares<Doubles> shares{PredictionPlane<Doubles>(wide)};
    for (std::size_t i = 0; i < kSamples; ++i) {
      Doubles share, w, east, north;
      widen(weight[i], w), widen(dx[i], east), widen(dy[i], north);
      shares.find(share, w, east, north);
      for (std::size_t k = 0; k < kLanes; ++k) shares_[first + k][i] = share[k];
    }
    for (std::size_t k = 0; k < kLanes; ++k) alone_[first + k] = sums.w[k] == 0;
  }
}

std::int64_t HeightPredictor::predict() const {
  const std::size_t j = next_ % kBatch;
  if (!moderate_ || alone_[j]) [[unlikely]]
    return predict_slowly();
  const Shares& shares = on_lattice() ? kShares[there_[j]] : shares_[j];
  const double* const heights = &heights_[bucket_[j]];
  const auto part = [&](std::size_t i) { return shares[i] * heights[around_[i]]; };
  // The sample at the point's left, mostly the latest one, comes last: its height is waited for.
  const double predicted = ((part(2) + part(3)) + (part(4) + part(6))) + ((part(5) + part(7)) + part(0)) + part(1);
  if (!(std::abs(predicted) < kGreatestDifference)) [[unlikely]]
    return predict_slowly();
  const double above = predicted + (kGreatestDifference + 0.5);
  const auto whole = static_cast<std::int64_t>(above);
  const double rest = above - static_cast<double>(whole);
  if (rest < kDoubt || rest > 1 - kDoubt) [[unlikely]]
    return predict_slowly();
  return whole - kGreatestDifference;
}

// Calls visit(weight, dx, dy, height) for the samples about the next point.
template <class Visit>
void HeightPredictor::for_each_sample(const Visit& visit) const {
  const std::size_t j = next_ % kBatch;
  for (std::size_t i = 0; i < kSamples; ++i) {
    auto [dx, dy] = kBucketsAround[i];
    if (on_lattice()) {
      if ((there_[j] >> i & 1) == 0) continue;
    } else {
      if (sample_x_[i][j] == kNone) continue;
      dx = (sample_x_[i][j] - x_[j]) >> offset_shift_, dy = (sample_y_[i][j] - y_[j]) >> offset_shift_;
    }
    visit(weight_of(dx, dy), dx, dy, heights_[bucket_[j] + static_cast<std::size_t>(around_[i])]);
  }
}

std::int64_t HeightPredictor::predict_slowly() const {
  PlaneMoments<double> plane;
  HeightMoments heights;
  constexpr double greatest = kGreatestDifference;
  for_each_sample([&](double weight, double dx, double dy, double height) {
    plane.add(weight, dx, dy);
    heights.add(weight, dx, dy, std::clamp(height - static_cast<double>(last_), -greatest, greatest));
  });
  if (plane.w == 0) return last_;
  const double above = std::clamp(PredictionPlane<double>(plane).intercept(heights), -2 * greatest, 2 * greatest);
  const double positive = above + 2 * greatest + 0.5;
  return last_ + static_cast<std::int64_t>(positive) - 2 * kGreatestDifference;
}

void HeightPredictor::add(std::int64_t z) {
  last_ = z;
  moderate_ = moderate_ && std::abs(z) <= kModerateHeight;
  heights_[bucket_[next_ % kBatch]] = static_cast<double>(z);
  if (++next_ % kBatch == 0 && next_ < positions_.size()) begin_batch();
}

}  // namespace itin
