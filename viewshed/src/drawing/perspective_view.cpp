#include <cmath>
#include <vector>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "drawing/surface_colours.hpp"
#include "drawing/surface_picture.hpp"

namespace itin::viewshed {

namespace {

constexpr Rgba kSkyColour{214, 228, 240};
/// What is nearer to the eye than this is not drawn, metres.
constexpr double kNearest = 0.1;
constexpr double kHeightOfWidth = 9.0 / 16;

class PerspectiveView {
 public:
  PerspectiveView(const Tin& tin, const PerspectiveOptions& options)
      : tin_(tin),
        options_(options),
        drop_(options.earth.drop_coefficient()),
        focal_(options.pixels * SurfacePicture::kSamples / 2.0 / std::tan(in_radians(options.field / 2))) {
    const double sin_a = std::sin(in_radians(options.azimuth)), cos_a = std::cos(in_radians(options.azimuth));
    const double sin_p = std::sin(in_radians(options.pitch)), cos_p = std::cos(in_radians(options.pitch));
    right_ = {cos_a, -sin_a, 0};
    up_ = {-sin_a * sin_p, -cos_a * sin_p, cos_p};
    forward_ = {sin_a * cos_p, cos_a * cos_p, sin_p};
  }

  MapImage draw() const {
    SurfacePicture picture(options_.pixels, static_cast<int>(std::lround(options_.pixels * kHeightOfWidth)),
                           kSkyColour);
    const SurfaceColours colours(tin_, options_.azimuth, options_.kinds);
    std::vector<Point3> seen;
    for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) seen.push_back(project(tin_.point(v)));
    for (const Triangle& t : tin_.triangles) {
      const std::vector<Point3> corners = in_front({seen[t[0]], seen[t[1]], seen[t[2]]});
      const Rgba colour = colours.of(t);
      for (std::size_t i = 2; i < corners.size(); ++i)
        picture.fill({in_plane(corners[0], picture), in_plane(corners[i - 1], picture), in_plane(corners[i], picture)},
                     colour, options_.edges);
    }
    return picture.image();
  }

 private:
  static double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

  /// How far a point is to the right of the eye, above it and in front of it. The Earth's curvature, less refraction,
  /// lowers what is far.
  Point3 project(const Point3& p) const {
    Point3 offset{p.x - options_.eye.x, p.y - options_.eye.y, p.z - options_.eye.z};
    offset.z -= drop_ * (offset.x * offset.x + offset.y * offset.y);
    return {dot(offset, right_), dot(offset, up_), dot(offset, forward_)};
  }

  /// The triangle as far as it lies in front of the eye.
  static std::vector<Point3> in_front(const std::array<Point3, 3>& t) {
    std::vector<Point3> kept;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 &p = t[i], &q = t[(i + 1) % 3];
      if (p.z >= kNearest) kept.push_back(p);
      if ((p.z >= kNearest) == (q.z >= kNearest)) continue;
      const double s = (kNearest - p.z) / (q.z - p.z);
      kept.push_back({p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), kNearest});
    }
    return kept;
  }

  SurfacePicture::Corner in_plane(const Point3& p, const SurfacePicture& picture) const {
    // The reciprocal of the distance is linear in the picture's plane.
    return {picture.width() / 2 + focal_ * p.x / p.z, picture.height() / 2 - focal_ * p.y / p.z, -1 / p.z};
  }

  const Tin& tin_;
  const PerspectiveOptions& options_;
  double drop_;
  double focal_;  ///< samples
  Point3 right_, up_, forward_;
};

}  // namespace

MapImage draw_perspective(const Tin& tin, const PerspectiveOptions& options) {
  if (!std::isfinite(options.azimuth) || !(std::abs(options.pitch) < 90))
    throw InputError("a view needs an azimuth, and a pitch between -90 and 90 degrees");
  if (!(options.field >= 1 && options.field <= 150)) throw InputError("a view's field is 1 to 150 degrees wide");
  require_drawable(tin, options.pixels);
  return PerspectiveView(tin, options).draw();
}

}  // namespace itin::viewshed
