// A picture in memory and the few shapes a map needs, drawn with smooth edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>

namespace itin::viewshed {

/// Pixel (0, 0) is the north-west one; its area is [0, 1] x [0, 1].
class Canvas {
 public:
  Canvas(int width, int height, Rgba background);

  int width() const { return width_; }
  int height() const { return height_; }
  std::vector<std::uint8_t>& rgb() { return rgb_; }

  /// Lays `colour` over a pixel; does nothing outside the picture. `opacity` is 0 to 1.
  void blend(int x, int y, Rgba colour, double opacity);
  void fill_rectangle(int x, int y, int width, int height, Rgba colour, double opacity = 1);
  /// Draws a frame one pixel wide, inside the rectangle.
  void frame(int x, int y, int width, int height, Rgba colour);
  void fill_disc(Point2 centre, double radius, Rgba colour, double opacity = 1);
  void fill_triangle(const std::array<Point2, 3>& corners, Rgba colour);

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> rgb_;
};

}  // namespace itin::viewshed
