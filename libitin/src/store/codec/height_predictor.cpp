#include "store/codec/height_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <variant>

#include <itin/precondition.hpp>

namespace itin {

namespace {

// The greatest difference of heights for which sums of products stay below 2^53.
constexpr std::int64_t kGreatestDifference = std::int64_t{1} << 20;
// Heights are moderate up to this one: their differences are at most kGreatestDifference.
constexpr std::int64_t kModerateHeight = kGreatestDifference / 2;
// Offsets are below 36 steps and differ by whole ones, so that shares are found from numbers below 10^4, with errors
// below 10^-11. With eight moderate heights these add up to less than 10^-4; FORMAT.md's arithmetic has no greater
// error.
constexpr double kDoubt = 1e-3;

}  // namespace

HeightPredictor::HeightPredictor(std::vector<LocalPosition> positions)
    : positions_(std::move(positions)),
      buckets_(positions_),
      heights_(buckets_.count()),
      samples_(samples_around(buckets_)) {
  begin_batch();
}

void HeightPredictor::begin_batch() {
  batch_.points = std::span(positions_).subspan(next_, std::min(kPointsOfBatch, positions_.size() - next_));
  for (std::size_t j = 0; j < batch_.points.size(); ++j) batch_.buckets[j] = buckets_.at(batch_.points[j]);
  std::visit([this](auto& samples) { samples.find_shares_around(batch_, shares_); }, samples_);
}

std::int64_t HeightPredictor::predict() const {
  ITIN_PRECONDITION(next_ > 0);
  const std::size_t j = next_ % kPointsOfBatch;
  if (!moderate_ || shares_[j] == nullptr) [[unlikely]]
    return predict_slowly();
  const Shares& shares = *shares_[j];
  const double* const heights = &heights_[batch_.buckets[j]];
  const auto part = [&](std::size_t i) { return shares[i] * heights[buckets_.around(i)]; };
  // The sample at the point's left is added last: it is mostly the latest one, whose height is still being computed.
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

std::int64_t HeightPredictor::predict_slowly() const {
  const std::size_t j = next_ % kPointsOfBatch;
  constexpr double greatest = kGreatestDifference;
  PlaneMoments<double> plane;
  HeightMoments heights;
  const auto add = [&](std::size_t i, const SampleAround& sample) {
    if (!sample.there) return;
    const double height = heights_[batch_.buckets[j] + static_cast<std::size_t>(buckets_.around(i))];
    const double weight = weight_at(sample.dx, sample.dy), dx = sample.dx, dy = sample.dy;
    plane.add(weight, dx, dy);
    heights.add(weight, dx, dy, std::clamp(height - static_cast<double>(last_), -greatest, greatest));
  };
  std::visit(
      [&](const auto& samples) {
        for (std::size_t i = 0; i < kSamplesAround; ++i) add(i, samples.sample(j, i));
      },
      samples_);
  if (plane.w == 0) return last_;
  const double above = std::clamp(PredictionPlane<double>(plane).intercept(heights), -2 * greatest, 2 * greatest);
  const double positive = above + 2 * greatest + 0.5;
  return last_ + static_cast<std::int64_t>(positive) - 2 * kGreatestDifference;
}

void HeightPredictor::add(std::int64_t z) {
  ITIN_PRECONDITION(std::abs(z) <= std::int64_t{1} << 33);
  last_ = z;
  moderate_ = moderate_ && std::abs(z) <= kModerateHeight;
  heights_[batch_.buckets[next_ % kPointsOfBatch]] = static_cast<double>(z);
  if (++next_ % kPointsOfBatch == 0 && next_ < positions_.size()) begin_batch();
}

}  // namespace itin
