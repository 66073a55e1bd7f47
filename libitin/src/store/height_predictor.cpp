#include "store/height_predictor.hpp"

#include <algorithm>
#include <array>

namespace itin {

namespace {

constexpr int kMaxOffset = 25;
constexpr std::int64_t kHeightLimit = std::int64_t{1} << 20;  // keeps every sum below 2^63

constexpr auto kWeights = [] {
  std::array<double, 2 * kMaxOffset * kMaxOffset + 1> weights{};
  for (std::uint32_t d2 = 0; d2 < weights.size(); ++d2) {
    const std::uint32_t weight = 65536 / (d2 + 1);
    weights[d2] = weight;
  }
  return weights;
}();

// Weighted sums over the samples. All are integers below 2^53, hence exact.
struct Moments {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, z = 0, xz = 0, yz = 0;

  void add(std::int64_t offset_x, std::int64_t offset_y, std::int64_t offset_z) {
    const double weight = kWeights[static_cast<std::size_t>(offset_x * offset_x + offset_y * offset_y)];
    const auto dx = static_cast<double>(offset_x), dy = static_cast<double>(offset_y);
    const auto dz = static_cast<double>(offset_z);
    const double wx = weight * dx, wy = weight * dy;
    w += weight, x += wx, y += wy;
    xx += wx * dx, xy += wx * dy, yy += wy * dy;
    z += weight * dz, xz += wx * dz, yz += wy * dz;
  }

  // The plane's height at the origin of the offsets.
  double intercept() const {
    const double spread_x = xx * w - x * x, spread_y = yy * w - y * y, cross = xy * w - x * y;
    const double damping = (spread_x + spread_y) * 0.125;
    const double a = spread_x + damping, c = spread_y + damping;
    const double determinant = a * c - cross * cross;
    if (!(determinant > 0)) return z / w;
    const double e = xz * w - x * z, f = yz * w - y * z;
    const double slope_x = e * c - f * cross, slope_y = a * f - cross * e;
    return (z - (slope_x * x + slope_y * y) / determinant) / w;
  }
};

}  // namespace

HeightPredictor::HeightPredictor(std::uint32_t width, std::uint32_t height, std::size_t count) {
  const auto buckets = [&](int shift) {
    return (std::uint64_t{(width - 1) >> shift} + 1) * (std::uint64_t{(height - 1) >> shift} + 1);
  };
  while (buckets(shift_) > 2 * count) ++shift_;
  offset_shift_ = std::max(0, shift_ - 3);
  stride_ = ((width - 1) >> shift_) + 1 + 2 * kMargin;
  latest_.resize(stride_ * (((height - 1) >> shift_) + 1 + 2 * kMargin));
  samples_.reserve(count);
}

std::int64_t HeightPredictor::predict(std::uint32_t x, std::uint32_t y) const {
  const std::size_t here = bucket(x, y);
  const std::array<std::size_t, 8> around = {
      here,     here - 1,          here - stride_, here - stride_ - 1, here - stride_ + 1, here + stride_ - 1,
      here - 2, here - 2 * stride_};
  const std::int64_t base = samples_.back().z;
  Moments moments;
  for (const std::size_t b : around) {
    if (latest_[b] == 0) continue;
    const Sample& s = samples_[latest_[b] - 1u];
    moments.add((static_cast<std::int64_t>(s.x) - x) >> offset_shift_,
                (static_cast<std::int64_t>(s.y) - y) >> offset_shift_,
                std::clamp(s.z - base, -kHeightLimit, kHeightLimit));
  }
  if (moments.w == 0) return base;
  const double limit = 2.0 * kHeightLimit;
  const double offset = std::clamp(moments.intercept(), -limit, limit) + limit + 0.5;
  return base + static_cast<std::int64_t>(offset) - 2 * kHeightLimit;
}

void HeightPredictor::add(std::uint32_t x, std::uint32_t y, std::int64_t z) {
  samples_.push_back({x, y, z});
  latest_[bucket(x, y)] = static_cast<std::uint16_t>(samples_.size());
}

}  // namespace itin
