#include "store/codec/height_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin {
namespace {

/// FORMAT.md, "Prediction", word for word.
class PredictionOfTheFormat {
 public:
  explicit PredictionOfTheFormat(std::vector<LocalPosition> positions) : positions_(std::move(positions)) {
    LocalPosition least = positions_[0], greatest = positions_[0];
    for (const LocalPosition& p : positions_) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y)};
      greatest = {std::max(greatest.x, p.x), std::max(greatest.y, p.y)};
    }
    for (LocalPosition& p : positions_) p = {p.x - least.x, p.y - least.y};
    const std::uint64_t width = greatest.x - least.x + 1, height = greatest.y - least.y + 1;
    while ((((width - 1) >> b_) + 1) * (((height - 1) >> b_) + 1) > 2 * positions_.size()) ++b_;
  }

  std::int64_t predict() const {
    const auto [u, v] = positions_[heights_.size()];
    const int i = bucket(u), j = bucket(v), c = std::max(0, b_ - 3);
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, z = 0, xz = 0, yz = 0;
    for (const auto& [k, l] : {std::pair{i, j},
                               {i - 1, j},
                               {i, j - 1},
                               {i - 1, j - 1},
                               {i + 1, j - 1},
                               {i - 1, j + 1},
                               {i - 2, j},
                               {i, j - 2}}) {
      const auto found = latest_.find({k, l});
      if (found == latest_.end()) continue;
      const LocalPosition& p = positions_[found->second];
      const std::int64_t dx = (std::int64_t{p.x} - u) >> c, dy = (std::int64_t{p.y} - v) >> c;
      const std::int64_t limit = 1 << 20, dz = std::clamp(heights_[found->second] - heights_.back(), -limit, limit);
      const std::int64_t weight = 65536 / (dx * dx + dy * dy + 1);
      const auto add = [weight](double& sum, std::int64_t term) { sum += static_cast<double>(weight * term); };
      add(w, 1), add(x, dx), add(y, dy), add(xx, dx * dx), add(xy, dx * dy), add(yy, dy * dy);
      add(z, dz), add(xz, dx * dz), add(yz, dy * dz);
    }
    if (w == 0) return heights_.back();
    const double sx = xx * w - x * x, sy = yy * w - y * y, t = xy * w - x * y;
    const double d = (sx + sy) * 0.125, a = sx + d, cc = sy + d, determinant = a * cc - t * t;
    double p = z / w;
    if (determinant > 0) {
      const double e = xz * w - x * z, f = yz * w - y * z, gx = e * cc - f * t, gy = a * f - t * e;
      p = (z - (gx * x + gy * y) / determinant) / w;
    }
    const double far = 1 << 21;
    return heights_.back() + static_cast<std::int64_t>(std::floor((std::clamp(p, -far, far) + far) + 0.5)) - (1 << 21);
  }

  void add(std::int64_t z) {
    const auto [u, v] = positions_[heights_.size()];
    latest_[{bucket(u), bucket(v)}] = heights_.size();
    heights_.push_back(z);
  }

 private:
  int bucket(std::uint32_t u) const { return static_cast<int>(u >> b_); }
  int b_ = 0;
  std::vector<LocalPosition> positions_;
  std::vector<std::int64_t> heights_;
  std::map<std::pair<int, int>, std::size_t> latest_;
};

/// A height where the prediction is `predicted`.
using Terrain = std::function<std::int64_t(const LocalPosition& p, std::int64_t predicted)>;

void expect_same_predictions(const std::vector<LocalPosition>& positions, const Terrain& terrain) {
  HeightPredictor fast(positions);
  PredictionOfTheFormat slow(positions);
  std::int64_t z = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i > 0) {
      const std::int64_t predicted = slow.predict();
      ASSERT_EQ(fast.predict(), predicted) << "point " << i << " of " << positions.size();
      z = terrain(positions[i], predicted);
    }
    fast.add(z);
    slow.add(z);
  }
}

/// One in `sparsity` of the places of a lattice, row by row.
std::vector<LocalPosition> some_of_a_lattice(std::uint32_t side, std::uint32_t sparsity, std::mt19937_64& random) {
  std::vector<LocalPosition> positions;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      if (random() % sparsity == 0 || positions.empty()) positions.push_back({x, y});
  return positions;
}

std::vector<LocalPosition> scattered(std::uint32_t side, std::size_t count, std::mt19937_64& random) {
  std::vector<LocalPosition> positions;
  for (std::size_t i = 0; i < count; ++i)
    positions.push_back({static_cast<std::uint32_t>(random() % side), static_cast<std::uint32_t>(random() % side)});
  const auto key = [](const LocalPosition& p) { return std::pair{p.x, p.y}; };
  std::sort(positions.begin(), positions.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); });
  positions.erase(
      std::unique(positions.begin(), positions.end(), [&](const auto& p, const auto& q) { return key(p) == key(q); }),
      positions.end());
  std::shuffle(positions.begin(), positions.end(), random);
  return positions;
}

class HeightPrediction : public testing::Test {
 protected:
  std::int64_t within(std::int64_t limit) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(2 * limit + 1)) - limit;
  }
  std::vector<std::vector<LocalPosition>> blocks() {
    std::vector<std::vector<LocalPosition>> all;
    for (const std::uint32_t sparsity : {1, 2, 3, 4, 8, 40, 300}) {
      all.push_back(some_of_a_lattice(40, sparsity, random_));
      std::vector<LocalPosition> turned = all.back();
      std::shuffle(turned.begin(), turned.end(), random_);
      all.push_back(turned);
    }
    for (const std::size_t count : {1, 2, 5, 33, 200, 1500})
      for (const int log2_side : {3, 6, 9, 12, 20, 30})
        all.push_back(scattered(std::uint32_t{1} << log2_side, count, random_));
    std::vector<LocalPosition> line;
    for (std::uint32_t i = 0; i < 100; ++i) line.push_back({3 * i, 5 * i});
    all.push_back(line);
    return all;
  }

  std::mt19937_64 random_{test::seed()};
};

TEST_F(HeightPrediction, IsThatOfTheFormat) {
  const std::vector<Terrain> terrains = {
      [](const LocalPosition&, std::int64_t) { return 7; },
      // Flat but for steps of one: predictions often lie halfway between two whole numbers.
      [&](const LocalPosition&, std::int64_t) { return within(1); },
      [&](const LocalPosition& p, std::int64_t) { return std::int64_t{p.x % 4096} - 2 * (p.y % 4096) + within(3); },
      [&](const LocalPosition&, std::int64_t predicted) { return predicted + within(2); },
      [&](const LocalPosition&, std::int64_t) { return within(std::int64_t{1} << 16); },
      // About the greatest heights that are predicted by shares.
      [&](const LocalPosition&, std::int64_t) { return within(std::int64_t{1} << 19); },
      [&](const LocalPosition&, std::int64_t) { return within((std::int64_t{1} << 19) + 3); },
      // Some differ by more than counts.
      [&](const LocalPosition&, std::int64_t) { return within(700'000); },
      [&](const LocalPosition&, std::int64_t) { return random_() % 2 == 0 ? 1 << 19 : -(1 << 19); },
      [&](const LocalPosition&, std::int64_t) {
        return random_() % 100 == 0 ? within(std::int64_t{1} << 32) : within(9);
      },
      [&](const LocalPosition&, std::int64_t) { return within(std::int64_t{1} << 33); },
  };
  for (const std::vector<LocalPosition>& block : blocks())
    for (std::size_t i = 0; i < terrains.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "terrain " << i);
      expect_same_predictions(block, terrains[i]);
      if (HasFatalFailure()) return;
    }
}

TEST_F(HeightPrediction, CountsPositionsFromTheCornerOfTheirExtent) {
  const std::vector<LocalPosition> positions = scattered(1 << 10, 300, random_);
  std::vector<LocalPosition> moved = positions;
  for (LocalPosition& p : moved) p.x += 1000, p.y += 77;
  HeightPredictor there(positions), elsewhere(moved);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i > 0) {
      ASSERT_EQ(there.predict(), elsewhere.predict());
    }
    const std::int64_t z = within(500);
    there.add(z), elsewhere.add(z);
  }
}

}  // namespace
}  // namespace itin
