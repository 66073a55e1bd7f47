#include "drawing/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace itin::viewshed {

namespace {

constexpr int kSubsamples = 4;  ///< per side

/// The share of a pixel's area for which `inside(x, y)` holds.
template <class Inside>
double coverage(int x, int y, const Inside& inside) {
  int count = 0;
  for (int i = 0; i < kSubsamples; ++i)
    for (int j = 0; j < kSubsamples; ++j)
      count += inside(x + (i + 0.5) / kSubsamples, y + (j + 0.5) / kSubsamples) ? 1 : 0;
  return static_cast<double>(count) / (kSubsamples * kSubsamples);
}

int floor_pixel(double v) {
  return static_cast<int>(std::floor(v));
}

}  // namespace

Canvas::Canvas(int width, int height, Rgba background)
    : width_(width), height_(height), rgb_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  fill_rectangle(0, 0, width, height, background);
}

void Canvas::blend(int x, int y, Rgba colour, double opacity) {
  if (opacity == 0 || x < 0 || y < 0 || x >= width_ || y >= height_) return;
  std::uint8_t* const pixel =
      rgb_.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  const std::array<std::uint8_t, 3> over{colour.red, colour.green, colour.blue};
  if (opacity == 1) {
    std::copy(over.begin(), over.end(), pixel);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(pixel[i] + opacity * (over[i] - pixel[i])));
}

void Canvas::fill_rectangle(int x, int y, int width, int height, Rgba colour, double opacity) {
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) blend(column, row, colour, opacity);
}

void Canvas::frame(int x, int y, int width, int height, Rgba colour) {
  fill_rectangle(x, y, width, 1, colour);
  fill_rectangle(x, y + height - 1, width, 1, colour);
  fill_rectangle(x, y, 1, height, colour);
  fill_rectangle(x + width - 1, y, 1, height, colour);
}

void Canvas::fill_disc(Point2 centre, double radius, Rgba colour, double opacity) {
  const auto inside = [&](double x, double y) { return std::hypot(x - centre.x, y - centre.y) <= radius; };
  for (int y = floor_pixel(centre.y - radius); y <= floor_pixel(centre.y + radius); ++y)
    for (int x = floor_pixel(centre.x - radius); x <= floor_pixel(centre.x + radius); ++x)
      blend(x, y, colour, opacity * coverage(x, y, inside));
}

void Canvas::fill_triangle(const std::array<Point2, 3>& corners, Rgba colour) {
  const auto inside = [&](double x, double y) {
    bool left = true, right = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 &a = corners[i], &b = corners[(i + 1) % 3];
      const double side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
      left = left && side >= 0, right = right && side <= 0;
    }
    return left || right;
  };
  Box box;
  for (const Point2& p : corners) box.extend(p);
  for (int y = floor_pixel(box.ymin); y <= floor_pixel(box.ymax); ++y)
    for (int x = floor_pixel(box.xmin); x <= floor_pixel(box.xmax); ++x) blend(x, y, colour, coverage(x, y, inside));
}

}  // namespace itin::viewshed
