#include "modes/lines/visibility_probability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <itin/sort_unique.hpp>

#include "line/infinity.hpp"
#include "line/sight_line.hpp"

namespace itin::viewshed {

namespace {

/// The weights of a triangle's corners at a position.
std::array<double, 3> weights_at(const std::array<GridPoint, 3>& corners, const Point3& p) {
  const auto& [a, b, c] = corners;
  const double bx = 1.0 * b.x - a.x, by = 1.0 * b.y - a.y, cx = 1.0 * c.x - a.x, cy = 1.0 * c.y - a.y;
  const double doubled_area = bx * cy - by * cx, x = p.x - a.x, y = p.y - a.y;
  const double wb = (x * cy - y * cx) / doubled_area, wc = (bx * y - by * x) / doubled_area;
  return {1 - wb - wc, wb, wc};
}

}  // namespace

VisibilityProbability::VisibilityProbability(std::shared_ptr<const HeightPyramid> surface, const Earth& earth,
                                             const VerticalError& error)
    : surface_(std::move(surface)),
      drop_(earth.drop_coefficient() * surface_->units().resolution),
      grazing_(kGrazing / surface_->units().resolution),
      sigma_(error.sigma / surface_->units().resolution),
      correlation_(error.correlation_length / surface_->units().resolution) {}

VisibilityProbability::Odds VisibilityProbability::of_line(const Line& line, Scratch& scratch) const {
  if (!cross(line, scratch)) return {0, false};
  const std::vector<Crossing>& crossings = scratch.crossings_;
  const bool clear =
      std::none_of(crossings.begin(), crossings.end(), [&](const Crossing& c) { return c.rise > grazing_; });
  if (crossings.empty() && line.from_stands && line.to_stands) return {1, clear};
  const Footing from = under(line.from), to = under(line.to);
  ErrorsAlongLine& errors = scratch.errors_;
  errors.begin(from.error, to.error);
  Margins least;
  least.fill(std::numeric_limits<float>::max());
  if (!line.from_stands) narrow(least, from.above, errors.from());
  if (!line.to_stands) narrow(least, to.above, errors.to());
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    narrow(least, line, crossings[i], errors);
    if (i % kCrossingsPerCount == 0 && share_seen(least) == 0) break;
  }
  return {share_seen(least), clear};
}

double VisibilityProbability::share_seen(const Margins& least) {
  const auto seen = std::count_if(least.begin(), least.end(), [](float margin) { return margin >= 0; });
  return static_cast<double>(seen) / static_cast<double>(least.size());
}

/// Narrows the margins by how far a fixed end is above ground; `above` is in grid units.
void VisibilityProbability::narrow(Margins& least, double above, const ErrorsAlongLine::Errors& ground) const {
  const auto middle = static_cast<float>((grazing_ + above) / sigma_);
  for (std::size_t w = 0; w < least.size(); ++w) least[w] = std::min(least[w], middle - ground[w]);
}

/// Narrows the margins by how far a line passes above an edge.
void VisibilityProbability::narrow(Margins& least, const Line& line, const Crossing& c, ErrorsAlongLine& errors) const {
  const auto& a = errors.of(c.a);
  const auto& b = errors.of(c.b);
  const auto& from = errors.from();
  const auto& to = errors.to();
  const auto middle = static_cast<float>((grazing_ - c.rise) / sigma_),
             by_from = line.from_stands ? static_cast<float>(1 - c.at) : 0.0F,
             by_to = line.to_stands ? static_cast<float>(c.at) : 0.0F, by_b = static_cast<float>(c.weight_b),
             by_a = 1 - by_b;
  for (std::size_t w = 0; w < least.size(); ++w)
    least[w] = std::min(least[w], middle + by_from * from[w] + by_to * to[w] - by_a * a[w] - by_b * b[w]);
}

/// Finds the edges that come near the line, in order. Returns false where one surely hides it.
bool VisibilityProbability::cross(const Line& line, Scratch& scratch) const {
  // The variance of a clearance is at most twice that of a vertex. As correlations fall with distance, it is also at
  // most what it would be without them.
  const double sure = kSure * std::numbers::sqrt2 * sigma_, hidden = kHidden * std::numbers::sqrt2 * sigma_;
  const auto surely_below = [&](double rise, double at) {
    const double rest = 1 - at;
    return rise <= 0 && rise * rise >= kSure * kSure * sigma_ * sigma_ * (1 + at * at + rest * rest);
  };
  const Tin& tin = surface_->tin();
  const SightLine sight(line.from, line.to, drop_, grazing_);
  std::vector<Crossing>& crossings = scratch.crossings_;
  crossings.clear();
  LineBundle bundle(sight);
  bundle.margin = sure;
  double highest = -sure;
  const auto add = [&](std::uint32_t triangle) {
    Triangle t = tin.triangles[triangle];
    // The corners are sorted so that an edge's two triangles see it alike.
    std::sort(t.begin(), t.end());
    sight.for_each_crossing({tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]},
                            [&](std::size_t i, std::size_t j, double weight, double at, double rise) {
                              if (surely_below(rise, at)) return;
                              crossings.push_back({at, rise, t[i], t[j], weight});
                              if (rise > highest) highest = rise, scratch.highest_ = triangle;
                            });
    // Nothing more needs to be looked at.
    if (highest >= hidden) bundle.margin = -kInfinity;
  };
  if (const auto last = scratch.highest_) add(*last);
  if (highest < hidden) surface_->search(bundle, add);
  if (highest >= hidden) return false;
  sort_unique(crossings);
  return true;
}

/// The ground under an end; far below where there is none.
VisibilityProbability::Footing VisibilityProbability::under(const Point3& end) const {
  const auto triangle = surface_->triangle_at({end.x, end.y});
  if (!triangle) return {{}, std::numeric_limits<float>::max()};
  const Tin& tin = surface_->tin();
  const std::array<GridPoint, 3> corners = tin.corners(*triangle);
  Footing footing{{tin.triangles[*triangle], weights_at(corners, end), 3}, end.z};
  for (std::size_t i = 0; i < 3; ++i) footing.above -= footing.error.weight[i] * corners[i].z;
  return footing;
}

}  // namespace itin::viewshed
