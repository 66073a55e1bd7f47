#include "drawing/surface_picture.hpp"

#include <algorithm>
#include <cmath>

#include <itin/error.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

using Corner = SurfacePicture::Corner;

/// How far an edge is drawn to either side, in samples.
constexpr double kEdge = 0.8;
constexpr double kEdgeShade = 0.45;

Rgba darker(const Rgba& c) {
  const auto part = [](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(value * kEdgeShade)); };
  return {part(c.red), part(c.green), part(c.blue)};
}

/// How much each corner weighs at a place that lies at this distance from the side opposite to it.
std::array<double, 3> weights_within(double distance, const std::array<Corner, 3>& s, double area) {
  std::array<double, 3> weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &p = s[(i + 1) % 3], &q = s[(i + 2) % 3];
    weights[i] = distance * std::hypot(q.x - p.x, q.y - p.y) / std::abs(area);
  }
  return weights;
}

/// The range of x in which a row crosses a triangle.
std::pair<double, double> range_in(const std::array<Corner, 3>& s, double y) {
  double from = kInfinity, to = -from;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &p = s[i], &q = s[(i + 1) % 3];
    if ((p.y < y && q.y < y) || (p.y > y && q.y > y)) continue;
    const double at = p.y == q.y ? p.x : p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
    from = std::min({from, at, p.y == q.y ? q.x : at});
    to = std::max({to, at, p.y == q.y ? q.x : at});
  }
  return {from, to};
}

}  // namespace

void require_drawable(const Tin& tin, int pixels) {
  if (pixels < 200 || pixels > 16000) throw InputError("a view has 200 to 16000 pixels on each side");
  if (tin.triangles.empty()) throw InputError("there is no ground in the window, so nothing to draw");
}

SurfacePicture::SurfacePicture(int width, int height, Rgba background)
    : width_(width * kSamples), height_(height * kSamples) {
  colours_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), background);
  depths_.assign(colours_.size(), kFloatInfinity);
}

void SurfacePicture::fill(const std::array<Corner, 3>& given, Rgba colour, bool edges) {
  std::array<Corner, 3> s = given;
  for (Corner& corner : s) corner.x -= 0.5, corner.y -= 0.5;  // samples lie at the middle of their squares
  const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y);
  if (area == 0) return;
  const Rgba edge = darker(colour);
  const std::array<double, 3> edge_weights = weights_within(kEdge, s, area);
  const auto [low, high] = std::minmax({s[0].y, s[1].y, s[2].y});
  const int last = static_cast<int>(std::min(height_ - 1.0, std::floor(high)));
  for (int y = static_cast<int>(std::max(0.0, std::ceil(low))); y <= last; ++y) {
    const auto [from, to] = range_in(s, y);
    const int end = static_cast<int>(std::min(width_ - 1.0, std::floor(to)));
    for (int x = static_cast<int>(std::max(0.0, std::ceil(from))); x <= end; ++x) {
      const double wb = ((x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (y - s[0].y)) / area;
      const double wc = ((s[1].x - s[0].x) * (y - s[0].y) - (x - s[0].x) * (s[1].y - s[0].y)) / area;
      const auto depth =
          static_cast<float>(s[0].depth + wb * (s[1].depth - s[0].depth) + wc * (s[2].depth - s[0].depth));
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
      if (depth >= depths_[i]) continue;
      depths_[i] = depth;
      const bool on_edge = edges && (1 - wb - wc < edge_weights[0] || wb < edge_weights[1] || wc < edge_weights[2]);
      colours_[i] = on_edge ? edge : colour;
    }
  }
}

MapImage SurfacePicture::image() const {
  MapImage image;
  image.width = width_ / kSamples, image.height = height_ / kSamples;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) add_pixel(x, y, image.rgb);
  return image;
}

void SurfacePicture::add_pixel(int x, int y, std::vector<std::uint8_t>& rgb) const {
  std::array<int, 3> sums{};
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const std::size_t at = static_cast<std::size_t>(y * kSamples + j) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(x * kSamples + i);
      const Rgba& c = colours_[at];
      sums[0] += c.red, sums[1] += c.green, sums[2] += c.blue;
    }
  }
  for (const int sum : sums) rgb.push_back(static_cast<std::uint8_t>(sum / (kSamples * kSamples)));
}

}  // namespace itin::viewshed
