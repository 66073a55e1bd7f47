// Triangles drawn into a picture, what is nearer in front of what is farther, each pixel an average of samples.
//
//   SurfacePicture picture(1600, 900, sky);
//   picture.fill({{{x, y, depth}, ...}}, colours.of(triangle), edges);
//   return picture.image();
#pragma once

#include <array>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>
#include <viewshed/map_image.hpp>

namespace itin::viewshed {

/// Throws InputError for a width that pictures do not have, and for a surface without triangles.
void require_drawable(const Tin& tin, int pixels);

class SurfacePicture {
 public:
  /// Samples along each side of a pixel.
  static constexpr int kSamples = 2;

  /// A corner in the picture's plane, samples right and down of its north-west corner, and any measure of how far away
  /// it is that is linear in the plane.
  struct Corner {
    double x = 0, y = 0, depth = 0;
  };

  /// Width and height are in pixels.
  SurfacePicture(int width, int height, Rgba background);

  double width() const { return width_; }    ///< samples
  double height() const { return height_; }  ///< samples
  /// Takes the samples whose centres the triangle covers and that nothing nearer has taken. With `edges`, samples near
  /// a side are darker.
  void fill(const std::array<Corner, 3>& corners, Rgba colour, bool edges);
  MapImage image() const;

 private:
  void add_pixel(int x, int y, std::vector<std::uint8_t>& rgb) const;

  int width_, height_;  ///< samples
  std::vector<Rgba> colours_;
  std::vector<float> depths_;
};

}  // namespace itin::viewshed
