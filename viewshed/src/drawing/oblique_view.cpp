#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "drawing/canvas.hpp"

namespace itin::viewshed {

namespace {

/// Pixels are averages of so many by so many samples.
constexpr int kSamples = 2;
/// Samples to either side of an edge.
constexpr double kEdge = 0.8;
constexpr double kEdgeShade = 0.45;
/// This share of the picture's longer side is left free around the surface.
constexpr double kMargin = 0.02;
constexpr double kAmbient = 0.42;
/// Surfaces steeper than this are walls: the cosine of their slope.
constexpr double kWall = 0.3;

constexpr Colour kPaper{255, 255, 255}, kGround{206, 207, 186}, kWalls{238, 228, 208};
constexpr std::array<Colour, 6> kThemes{
    {{190, 92, 66}, {104, 144, 84}, {146, 146, 150}, {96, 128, 176}, {184, 152, 82}, {150, 98, 158}}};

/// Metres in the picture's plane, and away from the viewer.
struct Seen {
  double right, up, away;
};

class View {
 public:
  View(const Tin& tin, const ObliqueOptions& options) : tin_(tin), edges_(options.edges) {
    const double degree = std::numbers::pi / 180;
    sin_a_ = std::sin(options.azimuth * degree), cos_a_ = std::cos(options.azimuth * degree);
    sin_e_ = std::sin(options.elevation * degree), cos_e_ = std::cos(options.elevation * degree);
    const Box box = tin.bounds();
    centre_ = {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
    // From behind the viewer's left shoulder.
    const double light = (options.azimuth - 50) * degree, height = 42 * degree;
    light_ = {-std::sin(light) * std::cos(height), -std::cos(light) * std::cos(height), std::sin(height)};
    for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
      seen_.push_back(project(tin.point(v)));
      left_ = std::min(left_, seen_.back().right), right_ = std::max(right_, seen_.back().right);
      low_ = std::min(low_, seen_.back().up), high_ = std::max(high_, seen_.back().up);
    }
    const double longer = std::max({right_ - left_, high_ - low_, tin.grid.resolution}), margin = kMargin * longer;
    scale_ = kSamples * options.pixels / (longer + 2 * margin);
    left_ -= margin, high_ += margin;
    width_ = side(right_ + margin - left_), height_ = side(high_ - low_ + margin);
    colours_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kPaper);
    depths_.assign(colours_.size(), std::numeric_limits<float>::infinity());
  }

  MapImage draw() {
    for (const Triangle& t : tin_.triangles) fill(t);
    MapImage image;
    image.width = width_ / kSamples, image.height = height_ / kSamples;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) add_pixel(x, y, image.rgb);
    }
    return image;
  }

 private:
  Seen project(const Point3& p) const {
    const double x = p.x - centre_.x, y = p.y - centre_.y;
    const double right = x * cos_a_ - y * sin_a_, forward = x * sin_a_ + y * cos_a_;
    return {right, forward * sin_e_ + p.z * cos_e_, forward * cos_e_ - p.z * sin_e_};
  }

  /// In samples, a whole number of pixels.
  int side(double metres) const {
    return std::max(1, static_cast<int>(std::ceil(metres * scale_ / kSamples))) * kSamples;
  }

  Colour colour(const Triangle& t) const {
    const Point3 a = tin_.point(t[0]), b = tin_.point(t[1]), c = tin_.point(t[2]);
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double length = std::hypot(nx, ny, nz);
    const double lit = length > 0 ? std::max(0.0, (nx * light_[0] + ny * light_[1] + nz * light_[2]) / length) : 1;
    const std::uint16_t theme = tin_.theme(t);
    const Colour& plain = theme == 0 ? kGround : nz < kWall * length ? kWalls : kThemes[(theme - 1U) % kThemes.size()];
    const double shade = kAmbient + (1 - kAmbient) * std::min(1.0, lit * 1.25);
    const auto shaded = [&](std::uint8_t c8) { return static_cast<std::uint8_t>(std::lround(c8 * shade)); };
    return {shaded(plain.red), shaded(plain.green), shaded(plain.blue)};
  }

  static Colour darker(const Colour& c) {
    const auto part = [](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(value * kEdgeShade)); };
    return {part(c.red), part(c.green), part(c.blue)};
  }

  /// Each corner's barycentric coordinate at this distance from the side opposite.
  static std::array<double, 3> weights_within(double distance, const std::array<Seen, 3>& s, double area) {
    std::array<double, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Seen &p = s[(i + 1) % 3], &q = s[(i + 2) % 3];
      weights[i] = distance * std::hypot(q.right - p.right, q.up - p.up) / std::abs(area);
    }
    return weights;
  }

  /// Samples whose centres the triangle covers and that nothing nearer has taken.
  void fill(const Triangle& t) {
    std::array<Seen, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Seen& p = seen_[t[i]];
      s[i] = {(p.right - left_) * scale_ - 0.5, (high_ - p.up) * scale_ - 0.5, p.away};
    }
    const double area =
        (s[1].right - s[0].right) * (s[2].up - s[0].up) - (s[2].right - s[0].right) * (s[1].up - s[0].up);
    if (area == 0) return;
    const Colour shade = colour(t), edge = darker(shade);
    const std::array<double, 3> edge_weights = weights_within(kEdge, s, area);
    const auto [low, high] = std::minmax({s[0].up, s[1].up, s[2].up});
    const int first = std::max(0, static_cast<int>(std::ceil(low)));
    const int last = std::min(height_ - 1, static_cast<int>(std::floor(high)));
    for (int y = first; y <= last; ++y) {
      double from = std::numeric_limits<double>::infinity(), to = -from;
      for (std::size_t i = 0; i < 3; ++i) {
        const Seen &p = s[i], &q = s[(i + 1) % 3];
        if ((p.up < y && q.up < y) || (p.up > y && q.up > y)) continue;
        const double at = p.up == q.up ? p.right : p.right + (y - p.up) / (q.up - p.up) * (q.right - p.right);
        from = std::min({from, at, p.up == q.up ? q.right : at});
        to = std::max({to, at, p.up == q.up ? q.right : at});
      }
      for (int x = std::max(0, static_cast<int>(std::ceil(from))); x <= std::min(width_ - 1.0, std::floor(to)); ++x) {
        const double wb = ((x - s[0].right) * (s[2].up - s[0].up) - (s[2].right - s[0].right) * (y - s[0].up)) / area;
        const double wc = ((s[1].right - s[0].right) * (y - s[0].up) - (x - s[0].right) * (s[1].up - s[0].up)) / area;
        const auto away = static_cast<float>(s[0].away + wb * (s[1].away - s[0].away) + wc * (s[2].away - s[0].away));
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (away >= depths_[i]) continue;
        depths_[i] = away;
        const bool on_edge = edges_ && (1 - wb - wc < edge_weights[0] || wb < edge_weights[1] || wc < edge_weights[2]);
        colours_[i] = on_edge ? edge : shade;
      }
    }
  }

  void add_pixel(int x, int y, std::vector<std::uint8_t>& rgb) const {
    std::array<int, 3> sums{};
    for (int j = 0; j < kSamples; ++j) {
      for (int i = 0; i < kSamples; ++i) {
        const std::size_t at = static_cast<std::size_t>(y * kSamples + j) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(x * kSamples + i);
        const Colour& c = colours_[at];
        sums[0] += c.red, sums[1] += c.green, sums[2] += c.blue;
      }
    }
    for (const int sum : sums) rgb.push_back(static_cast<std::uint8_t>(sum / (kSamples * kSamples)));
  }

  const Tin& tin_;
  bool edges_;
  Point2 centre_;
  double sin_a_ = 0, cos_a_ = 1, sin_e_ = 0, cos_e_ = 1;
  std::array<double, 3> light_{};
  std::vector<Seen> seen_;
  double left_ = std::numeric_limits<double>::infinity(), right_ = -left_, low_ = left_, high_ = -left_;
  double scale_ = 1;  ///< samples per metre
  int width_ = 0, height_ = 0;
  std::vector<Colour> colours_;
  std::vector<float> depths_;
};

}  // namespace

MapImage draw_oblique(const Tin& tin, const ObliqueOptions& options) {
  if (!(options.elevation > 0 && options.elevation <= 90) || !std::isfinite(options.azimuth))
    throw InputError("a view needs an azimuth, and an elevation above 0 and up to 90 degrees");
  if (options.pixels < 200 || options.pixels > 16000) throw InputError("a view has 200 to 16000 pixels a side");
  if (tin.triangles.empty()) throw InputError("there is no ground in the window, so nothing to draw");
  return View(tin, options).draw();
}

}  // namespace itin::viewshed
