// Tins that look like terrain: lattices cut into triangles, with heights from a function or from fractal noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <itin/tin.hpp>

namespace itin::test {

/// Heights in metres at column, row; NaN leaves the post out.
using HeightAt = std::function<double(std::int32_t column, std::int32_t row)>;

/// The place of such terrain, unless a test says otherwise.
inline constexpr Point2 kCorner{300000, 200000};

/// columns x rows posts, `spacing` metres apart, the first at `corner`; each square with four posts is cut along one
/// of its diagonals, alternately.
inline Tin lattice_tin(std::int32_t columns, std::int32_t rows, double spacing, const HeightAt& height,
                       double resolution = 0.01, Point2 corner = kCorner) {
  Tin tin;
  tin.grid = {corner, resolution};
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), kNone);
  const auto at = [&](std::int32_t c, std::int32_t r) -> std::uint32_t& {
    return number[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  };
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) {
      const double z = height(c, r);
      if (std::isnan(z)) continue;
      at(c, r) = static_cast<std::uint32_t>(tin.vertices.size());
      tin.vertices.push_back(tin.grid.quantise({corner.x + c * spacing, corner.y + r * spacing, z}));
    }
  }
  tin.sources.assign(tin.vertices.size(), 0);
  for (std::int32_t r = 0; r + 1 < rows; ++r) {
    for (std::int32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t sw = at(c, r), se = at(c + 1, r), nw = at(c, r + 1), ne = at(c + 1, r + 1);
      if (std::max({sw, se, nw, ne}) == kNone) continue;
      if ((c + r) % 2 == 0) {
        tin.triangles.push_back({sw, se, ne});
        tin.triangles.push_back({sw, ne, nw});
      } else {
        tin.triangles.push_back({sw, se, nw});
        tin.triangles.push_back({se, ne, nw});
      }
    }
  }
  return tin;
}

/// Fractal terrain by midpoint displacement: side = 2^k + 1 posts, heights of about +- `relief` metres.
inline std::vector<double> fractal_heights(std::int32_t side, double relief, double roughness, std::uint32_t seed) {
  std::mt19937 random(seed);
  // std::normal_distribution is not used: its sequence differs between libraries.
  const auto noise = [&](double scale) { return scale * (static_cast<double>(random()) / 2147483648.0 - 1.0); };
  std::vector<double> z(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const auto at = [&](std::int32_t c, std::int32_t r) -> double& {
    return z[static_cast<std::size_t>(r) * static_cast<std::size_t>(side) + static_cast<std::size_t>(c)];
  };
  const std::int32_t last = side - 1;
  for (const auto& [c, r] : {std::pair{0, 0}, {last, 0}, {0, last}, {last, last}}) at(c, r) = noise(relief);
  for (std::int32_t step = last; step > 1; step /= 2, relief *= roughness) {
    const std::int32_t half = step / 2;
    for (std::int32_t r = half; r < side; r += step)
      for (std::int32_t c = half; c < side; c += step)
        at(c, r) =
            (at(c - half, r - half) + at(c + half, r - half) + at(c - half, r + half) + at(c + half, r + half)) / 4 +
            noise(relief);
    for (std::int32_t r = 0; r < side; r += half) {
      for (std::int32_t c = (r / half + 1) % 2 * half; c < side; c += step) {
        double sum = 0;
        int count = 0;
        if (c >= half) sum += at(c - half, r), ++count;
        if (c + half < side) sum += at(c + half, r), ++count;
        if (r >= half) sum += at(c, r - half), ++count;
        if (r + half < side) sum += at(c, r + half), ++count;
        at(c, r) = sum / count + noise(relief);
      }
    }
  }
  return z;
}

inline Tin fractal_tin(std::int32_t side, double spacing, double relief, double roughness, std::uint32_t seed) {
  const std::vector<double> z = fractal_heights(side, relief, roughness, seed);
  return lattice_tin(side, side, spacing, [&](std::int32_t c, std::int32_t r) {
    return z[static_cast<std::size_t>(r) * static_cast<std::size_t>(side) + static_cast<std::size_t>(c)];
  });
}

}  // namespace itin::test
