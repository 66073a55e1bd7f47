#include "store/height_predictor.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace itin {

namespace {

constexpr int kMaxOffset = 25;

constexpr auto kWeights = [] {
  std::array<double, 2 * kMaxOffset * kMaxOffset + 1> weights{};
  for (std::uint32_t d2 = 0; d2 < weights.size(); ++d2) {
    const std::uint32_t weight = 65536 / (d2 + 1);
    weights[d2] = weight;
  }
  return weights;
}();

// Where the buckets lie that are looked at, from the point's own.
struct Offset {
  int x, y;
  constexpr std::int64_t weight() const { return 65536 / (x * x + y * y + 1); }
};
constexpr std::array<Offset, 8> kAround = {{{0, 0}, {-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-1, 1}, {-2, 0}, {0, -2}}};

// Weighted sums over the samples. All are integers below 2^53, hence exact, in whatever order they are added up.
struct Moments {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, z = 0, xz = 0, yz = 0;

  constexpr void add(double weight, double dx, double dy, double dz) {
    const double wx = weight * dx, wy = weight * dy;
    w += weight, x += wx, y += wy;
    xx += wx * dx, xy += wx * dy, yy += wy * dy;
    z += weight * dz, xz += wx * dz, yz += wy * dz;
  }
};

// The part of a least-squares plane that depends on the samples' positions alone.
struct Plane {
  double w = 0, x = 0, y = 0, a = 0, c = 0, cross = 0, determinant = 0;

  constexpr Plane() = default;
  constexpr explicit Plane(const Moments& m) : w(m.w), x(m.x), y(m.y), cross(m.xy * m.w - m.x * m.y) {
    const double spread_x = m.xx * m.w - m.x * m.x, spread_y = m.yy * m.w - m.y * m.y;
    const double damping = (spread_x + spread_y) * 0.125;
    a = spread_x + damping, c = spread_y + damping;
    determinant = a * c - cross * cross;
  }

  // Its height at the origin of the offsets.
  double intercept(double z, double xz, double yz) const {
    if (!(determinant > 0)) return z / w;
    const double e = xz * w - z * x, f = yz * w - z * y;
    const double slope_x = e * c - f * cross, slope_y = a * f - cross * e;
    return (z - (slope_x * x + slope_y * y) / determinant) / w;
  }
};

// Where buckets are single positions, by which of them hold a sample, as bits.
constexpr auto kPlanes = [] {
  std::array<Plane, std::size_t{1} << kAround.size()> planes{};
  for (std::size_t there = 0; there < planes.size(); ++there) {
    Moments moments;
    for (std::size_t i = 0; i < kAround.size(); ++i)
      if ((there >> i & 1) != 0) moments.add(static_cast<double>(kAround[i].weight()), kAround[i].x, kAround[i].y, 0);
    planes[there] = Plane(moments);
  }
  return planes;
}();

}  // namespace

HeightPredictor::HeightPredictor(std::uint32_t width, std::uint32_t height, std::size_t count) {
  const auto buckets = [&](int shift) {
    return (std::uint64_t{(width - 1) >> shift} + 1) * (std::uint64_t{(height - 1) >> shift} + 1);
  };
  while (buckets(shift_) > 2 * count) ++shift_;
  offset_shift_ = std::max(0, shift_ - 3);
  stride_ = ((width - 1) >> shift_) + 1 + 2 * kMargin;
  const std::size_t all = stride_ * (((height - 1) >> shift_) + 1 + 2 * kMargin);
  if (on_lattice()) {
    heights_.assign(all, kNoHeight);
  } else {
    latest_.resize(all);
    samples_.reserve(count);
  }
}

std::int64_t HeightPredictor::predict(std::uint32_t x, std::uint32_t y) const {
  const double limit = 2.0 * kHeightLimit;
  const double above = on_lattice() ? offset_on_lattice(x, y) : offset_among(x, y);
  const double offset = std::clamp(above, -limit, limit) + limit + 0.5;
  return last_ + static_cast<std::int64_t>(offset) - 2 * kHeightLimit;
}

double HeightPredictor::offset_on_lattice(std::uint32_t x, std::uint32_t y) const {
  const std::size_t here = bucket(x, y);
  const auto stride = static_cast<std::ptrdiff_t>(stride_);
  std::size_t there = 0;
  std::int64_t z = 0, xz = 0, yz = 0;
  const auto at_offset = [&](std::size_t number, const Offset& b) __attribute__((always_inline)) {
    const std::int64_t height = heights_[here + static_cast<std::size_t>(b.y * stride + b.x)];
    const bool is_there = height != kNoHeight;
    there |= std::size_t{is_there} << number;
    const std::int64_t wz = is_there ? b.weight() * above_last(height) : 0;
    z += wz, xz += wz * b.x, yz += wz * b.y;
  };
  // Without a loop, for all factors are constants then.
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (at_offset(i, kAround[i]), ...);
  }
  (std::make_index_sequence<kAround.size()>());
  return there == 0
             ? 0
             : kPlanes[there].intercept(static_cast<double>(z), static_cast<double>(xz), static_cast<double>(yz));
}

double HeightPredictor::offset_among(std::uint32_t x, std::uint32_t y) const {
  const std::size_t here = bucket(x, y);
  const auto stride = static_cast<std::ptrdiff_t>(stride_);
  Moments moments;
#pragma GCC unroll 8
  for (const Offset& b : kAround) {
    const Sample* const s = latest(here + static_cast<std::size_t>(b.y * stride + b.x));
    if (s == nullptr) continue;
    const std::int64_t east = (static_cast<std::int64_t>(s->x) - x) >> offset_shift_,
                       north = (static_cast<std::int64_t>(s->y) - y) >> offset_shift_;
    const double weight = kWeights[static_cast<std::size_t>(east * east + north * north)];
    moments.add(weight, static_cast<double>(east), static_cast<double>(north), static_cast<double>(above_last(s->z)));
  }
  return moments.w == 0 ? 0 : Plane(moments).intercept(moments.z, moments.xz, moments.yz);
}

void HeightPredictor::add(std::uint32_t x, std::uint32_t y, std::int64_t z) {
  last_ = z;
  if (on_lattice()) {
    heights_[bucket(x, y)] = z;
    return;
  }
  samples_.push_back({x, y, z});
  latest_[bucket(x, y)] = static_cast<std::uint16_t>(samples_.size());
}

}  // namespace itin
