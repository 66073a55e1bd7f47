#include "drawing/hillshade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/degrees.hpp>
#include <itin/parallel.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// A light by the direction that it comes from, as the sine and cosine of its azimuth.
struct Light {
  Light(double azimuth_degrees, double of_all)
      : east(std::sin(in_radians(azimuth_degrees))), north(std::cos(in_radians(azimuth_degrees))), weight(of_all) {}

  double east, north, weight;
};

/// Brightness of a slope with gradient (east, north).
double shade(double east, double north) {
  static const std::array<Light, 4> kLights{Light{315, 0.55}, Light{270, 0.15}, Light{0, 0.15}, Light{225, 0.15}};
  constexpr double kRise = kLevelShade;  // sine of the light's elevation, 40 degrees
  static const double kReach = std::sqrt(1 - kRise * kRise);
  const double steepness = std::sqrt(1 + east * east + north * north);
  double sum = 0;
  for (const Light& light : kLights) {
    const double facing = -east * light.east - north * light.north;
    sum += light.weight * std::max(0.0, (kRise + kReach * facing) / steepness);
  }
  return sum;
}

}  // namespace

Relief hillshade(const RasterGrid& pixels, std::vector<float> heights_m) {
  Relief relief{pixels, std::move(heights_m), std::vector<float>(pixels.cell_count(), kNothing)};
  const std::vector<float>& heights = relief.heights_m;
  float low = kFloatInfinity, high = -low;
  for (const float z : heights) {
    if (!std::isnan(z)) low = std::min(low, z), high = std::max(high, z);
  }
  // Gentle country is exaggerated and mountains are not: relief of a tenth of the map's width needs no help.
  const double width = std::max(pixels.bounds().width(), pixels.bounds().height());
  const double exaggeration = high > low ? std::clamp(0.12 * width / (high - low), 1.0, 6.0) : 1;
  const auto columns = pixels.columns(), rows = pixels.rows();
  const auto height = [&](std::int64_t column, std::int64_t row) {
    return heights[pixels.index(
        {std::clamp<std::int64_t>(column, 0, columns - 1), std::clamp<std::int64_t>(row, 0, rows - 1)})];
  };
  // Rise over two pixels, or over one at the edge of the surface; nothing where a pixel stands alone.
  const auto slope = [](float before, float here, float after, double step) {
    if (!std::isnan(before) && !std::isnan(after)) return (after - before) / (2 * step);
    if (!std::isnan(after)) return (after - here) / step;
    return std::isnan(before) ? 0.0 : (here - before) / step;
  };
  parallel_for(static_cast<std::size_t>(rows), [&](std::size_t r) {
    const auto row = static_cast<std::int64_t>(r);
    for (std::int64_t column = 0; column < columns; ++column) {
      const float here = height(column, row);
      if (std::isnan(here)) continue;
      const double east = slope(height(column - 1, row), here, height(column + 1, row), pixels.cell_width());
      const double north = slope(height(column, row + 1), here, height(column, row - 1), pixels.cell_height());
      relief.shades[pixels.index({column, row})] = static_cast<float>(shade(exaggeration * east, exaggeration * north));
    }
  });
  return relief;
}

}  // namespace itin::viewshed
