#include <algorithm>
#include <limits>
#include <numbers>

#include <itin/diffraction.hpp>
#include <itin/grazing.hpp>
#include <itin/precondition.hpp>

namespace itin {

namespace {

/// Returns the largest slope from an end of the span to an edge over the curved Earth, m/km: equations (14) and (17).
double steepest_from(const PathEdge& end, const PathSpan& span, std::span<const PathEdge> edges) {
  double steepest = -std::numeric_limits<double>::infinity();
  for (const PathEdge& e : edges) {
    const double bulge = span.bulge_m(e.km - span.a.km, span.b.km - e.km);
    steepest = std::max(steepest, (e.height_m + bulge - end.height_m) / std::abs(e.km - end.km));
  }
  return steepest;
}

/// Returns the loss over Bullington's edge: equation (22).
double loss_over(const std::optional<BullingtonEdge>& edge, const PathSpan& span) {
  if (!edge) return 0;
  const double single = knife_edge_db(edge->v);
  return single + (1 - std::exp(-single / 6)) * (10 + 0.02 * span.length());
}

}  // namespace

std::vector<PathEdge> edges_of(std::span<const PathPoint> profile, double length_m) {
  std::vector<PathEdge> edges;
  edges.reserve(profile.size());
  for (const PathPoint& p : profile)
    if (p.distance_m > 0 && p.distance_m < length_m) edges.push_back({p.distance_m / 1000, p.height_m});
  return edges;
}

std::vector<PathEdge> levelled(std::vector<PathEdge> edges) {
  for (PathEdge& e : edges) e.height_m = 0;
  return edges;
}

const PathEdge* largest_v(const PathSpan& span, std::span<const PathEdge> edges) {
  const PathEdge* best = nullptr;
  double largest = 0;
  for (const PathEdge& e : edges) {
    if (e.km <= span.a.km || e.km >= span.b.km) continue;
    const double v = span.v(e);
    if (best == nullptr || v >= largest) best = &e, largest = v;
  }
  return best;
}

double free_space_db(double distance_m, double wavelength) {
  return 20 * std::log10(4 * std::numbers::pi * distance_m / wavelength);
}

double knife_edge_db(double v) {
  if (v <= kFreeV) return 0;
  return 6.9 + 20 * std::log10(std::sqrt((v - 0.1) * (v - 0.1) + 1) + v - 0.1);
}

std::optional<BullingtonEdge> bullington_edge(const PathSpan& span, std::span<const PathEdge> edges) {
  if (edges.empty()) return std::nullopt;
  const double d = span.length(), rise = span.b.height_m - span.a.height_m;
  const double from_a = steepest_from(span.a, span, edges);
  if (from_a < rise / d) {
    const PathEdge& edge = *largest_v(span, edges);
    return BullingtonEdge{edge, span.v(edge)};
  }
  const double from_b = steepest_from(span.b, span, edges);
  const double at = (rise + from_b * d) / (from_a + from_b), top = span.a.height_m + from_a * at;
  return BullingtonEdge{{at, top - span.bulge_m(at, d - at)}, span.v_of(top - span.line_m(at, d - at), at, d - at)};
}

double bullington_db(const PathSpan& span, std::span<const PathEdge> edges) {
  return loss_over(bullington_edge(span, edges), span);
}

SmoothEnds smooth_ends(std::span<const PathPoint> ground, const PathEnds& ends) {
  ITIN_PRECONDITION(ground.size() >= 2);
  const double d = ends.length_m / 1000, from = ground.front().height_m, to = ground.back().height_m;
  double v1 = 0, v2 = 0;  // equations (161), (162)
  for (std::size_t i = 1; i < ground.size(); ++i) {
    const PathPoint &p = ground[i - 1], &q = ground[i];
    const double a = p.distance_m / 1000, b = q.distance_m / 1000;
    v1 += (b - a) * (q.height_m + p.height_m);
    v2 += (b - a) * (q.height_m * (2 * b + a) + p.height_m * (b + 2 * a));
  }
  SmoothEnds smooth{(2 * v1 * d - v2) / (d * d), (v2 - v1 * d) / (d * d), 0, 0};
  double highest = 0, towards_t = 0, towards_r = 0;  // equations (165a) to (165d), as far as they are positive
  for (const PathEdge& e : edges_of(ground, ends.length_m)) {
    const double above = e.height_m - (ends.from_m * (d - e.km) + ends.to_m * e.km) / d;
    highest = std::max(highest, above);
    towards_t = std::max(towards_t, above / e.km);
    towards_r = std::max(towards_r, above / (d - e.km));
  }
  const double share = highest > 0 ? towards_t / (towards_t + towards_r) : 0;
  smooth.hstd_m = std::min(smooth.hst_m - highest * share, from);
  smooth.hsrd_m = std::min(smooth.hsr_m - highest * (1 - share), to);
  return smooth;
}

std::optional<PathEnds> above_tops(PathEnds ends, double from_top_m, double to_top_m) {
  if (ends.from_m < from_top_m - kGrazing || ends.to_m < to_top_m - kGrazing) return std::nullopt;
  ends.from_m = std::max(ends.from_m, from_top_m), ends.to_m = std::max(ends.to_m, to_top_m);
  return ends;
}

DeltaBullington delta_bullington(std::span<const PathPoint> tops, std::span<const PathPoint> ground,
                                 const PathEnds& ends, const RadioPath& path) {
  ITIN_PRECONDITION(!tops.empty() && ends.length_m > 0 && path.frequency_ghz > 0 && path.effective_earth_km > 0);
  const PathSpan span(ends, path);
  DeltaBullington loss;
  loss.smooth = smooth_ends(ground, ends);
  std::vector<PathEdge> edges = edges_of(tops, ends.length_m);
  loss.edge = bullington_edge(span, edges);
  loss.lba_db = loss_over(loss.edge, span);
  // Equations (38a, 38b) have the antennas above the smooth surface.
  const PathEnds above{ends.length_m, ends.from_m - loss.smooth.hstd_m, ends.to_m - loss.smooth.hsrd_m};
  loss.lbs_db = bullington_db(PathSpan(above, path), levelled(std::move(edges)));
  loss.ldsph_db = spherical_earth_db(span.length(), above.from_m, above.to_m, path);
  loss.ld_db = loss.lba_db + std::max(loss.ldsph_db - loss.lbs_db, 0.0);
  return loss;
}

}  // namespace itin
