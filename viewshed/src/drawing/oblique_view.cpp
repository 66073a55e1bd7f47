#include <algorithm>
#include <cmath>
#include <vector>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "drawing/surface_colours.hpp"
#include "drawing/surface_picture.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

/// This share of the picture's longer side is left free around the surface.
constexpr double kFrame = 0.02;
constexpr Rgba kPaper{255, 255, 255};

/// Projects by parallel rays: to metres in the picture's plane, and away from the viewer.
class ParallelView {
 public:
  ParallelView(const Tin& tin, const ObliqueOptions& options) : tin_(tin), options_(options) {
    sin_a_ = std::sin(in_radians(options.azimuth)), cos_a_ = std::cos(in_radians(options.azimuth));
    sin_e_ = std::sin(in_radians(options.elevation)), cos_e_ = std::cos(in_radians(options.elevation));
    const Box box = tin.bounds();
    centre_ = {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
    for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
      seen_.push_back(project(tin.point(v)));
      left_ = std::min(left_, seen_.back().right), right_ = std::max(right_, seen_.back().right);
      low_ = std::min(low_, seen_.back().up), high_ = std::max(high_, seen_.back().up);
    }
  }

  MapImage draw() {
    const double longer = std::max({right_ - left_, high_ - low_, tin_.grid.resolution}), margin = kFrame * longer;
    const double pixels_per_metre = options_.pixels / (longer + 2 * margin);
    const auto side = [&](double metres) {
      return std::max(1, static_cast<int>(std::ceil(metres * pixels_per_metre)));
    };
    SurfacePicture picture(side(right_ - left_ + 2 * margin), side(high_ - low_ + 2 * margin), kPaper);
    const SurfaceColours colours(tin_, options_.azimuth, options_.kinds);
    const double scale = SurfacePicture::kSamples * pixels_per_metre;
    for (const Triangle& t : tin_.triangles) {
      std::array<SurfacePicture::Corner, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const Seen& p = seen_[t[i]];
        corners[i] = {(p.right - left_ + margin) * scale, (high_ + margin - p.up) * scale, p.away};
      }
      picture.fill(corners, colours.of(t), options_.edges);
    }
    return picture.image();
  }

 private:
  struct Seen {
    double right, up, away;
  };

  Seen project(const Point3& p) const {
    const double x = p.x - centre_.x, y = p.y - centre_.y;
    const double right = x * cos_a_ - y * sin_a_, forward = x * sin_a_ + y * cos_a_;
    return {right, forward * sin_e_ + p.z * cos_e_, forward * cos_e_ - p.z * sin_e_};
  }

  const Tin& tin_;
  const ObliqueOptions& options_;
  Point2 centre_;
  double sin_a_ = 0, cos_a_ = 1, sin_e_ = 0, cos_e_ = 1;
  std::vector<Seen> seen_;
  double left_ = kInfinity, right_ = -left_, low_ = left_, high_ = -left_;
};

}  // namespace

MapImage draw_oblique(const Tin& tin, const ObliqueOptions& options) {
  if (!(options.elevation > 0 && options.elevation <= 90) || !std::isfinite(options.azimuth))
    throw InputError("a view needs an azimuth, and an elevation above 0 and up to 90 degrees");
  require_drawable(tin, options.pixels);
  return ParallelView(tin, options).draw();
}

}  // namespace itin::viewshed
