#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/diffraction.hpp>

namespace itin::profile {

namespace {

/// A point strictly between the ends, in the recommendations' units.
struct Edge {
  double km;
  double height_m;
};

/// Edges of no greater v cost nothing: P.526-15 equation (31).
constexpr double kFreeV = -0.78;

// The rounding error of kilometres in decimals, metres: a point given 50 m from an end is not nearer.
constexpr double kHairM = 1e-6;

enum class Ground { kBare, kWithClutter, kSmooth };

double from_end(const Profile& profile, const ProfilePoint& p) {
  return std::min(p.distance_m, profile.length_m - p.distance_m);
}

std::vector<Edge> edges_of(const Profile& profile, Ground ground) {
  std::vector<Edge> edges;
  edges.reserve(profile.points.size());
  for (const ProfilePoint& p : profile.points) {
    if (from_end(profile, p) <= 0) continue;
    const double height = ground == Ground::kWithClutter ? clutter_top_m(profile, p) : p.ground_m;
    edges.push_back({p.distance_m / 1000, ground == Ground::kSmooth ? 0 : height});
  }
  return edges;
}

/// The span between two points that see each other or not: antennas, or an edge and an antenna.
struct Span {
  Edge a, b;
  double curvature;   ///< Ce = 1 / ae, 1/km
  double wavelength;  ///< m

  double length() const { return b.km - a.km; }
  double bulge_m(double d1, double d2) const { return 500 * curvature * d1 * d2; }
  double line_m(double d1, double d2) const { return (a.height_m * d2 + b.height_m * d1) / length(); }
  /// The parameter of an obstacle `above` metres over the line: P.452-17 equations (16) and (20).
  double v_of(double above, double d1, double d2) const {
    return above * std::sqrt(0.002 * length() / (wavelength * d1 * d2));
  }
  double v(const Edge& e) const {
    const double d1 = e.km - a.km, d2 = b.km - e.km;
    return v_of(e.height_m + bulge_m(d1, d2) - line_m(d1, d2), d1, d2);
  }
};

Span whole_span(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  return {{0, antennas.from_m},
          {profile.length_m / 1000, antennas.to_m},
          1 / path.effective_earth_km,
          wavelength_m(path.frequency_ghz)};
}

/// The edge strictly inside the span with the largest v, the last of equals; null where there is none.
const Edge* largest_v(const Span& span, const std::vector<Edge>& edges) {
  const Edge* best = nullptr;
  for (const Edge& e : edges) {
    if (e.km <= span.a.km || e.km >= span.b.km) continue;
    if (!best || span.v(e) >= span.v(*best)) best = &e;
  }
  return best;
}

/// The largest slope from an end of the span to an edge over the curved Earth, m/km: equations (14) and (17).
double steepest_from(const Edge& end, const Span& span, const std::vector<Edge>& edges) {
  double steepest = -std::numeric_limits<double>::infinity();
  for (const Edge& e : edges) {
    const double bulge = span.bulge_m(e.km - span.a.km, span.b.km - e.km);
    steepest = std::max(steepest, (e.height_m + bulge - end.height_m) / std::abs(e.km - end.km));
  }
  return steepest;
}

DiffractionEdge with_loss(const Edge& edge, double v) {
  return {edge.km * 1000, edge.height_m, v, knife_edge_loss_db(v)};
}

/// Bullington's single edge: equations (16), (18) to (20). Precondition: there are edges.
DiffractionEdge bullington_edge(const Span& span, const std::vector<Edge>& edges) {
  const double d = span.length(), rise = span.b.height_m - span.a.height_m;
  const double from_a = steepest_from(span.a, span, edges);
  if (from_a < rise / d) {
    const Edge& edge = *largest_v(span, edges);
    return with_loss(edge, span.v(edge));
  }
  const double from_b = steepest_from(span.b, span, edges);
  const double at = (rise + from_b * d) / (from_a + from_b), top = span.a.height_m + from_a * at;
  return with_loss({at, top - span.bulge_m(at, d - at)}, span.v_of(top - span.line_m(at, d - at), at, d - at));
}

double bullington(const Span& span, const std::vector<Edge>& edges) {
  if (edges.empty()) return 0;
  const double single = bullington_edge(span, edges).loss_db;
  return single + (1 - std::exp(-single / 6)) * (10 + 0.02 * span.length());  // equation (22)
}

/// The edge with the largest v, if it costs anything.
std::optional<DiffractionEdge> costly_edge(const Span& span, const std::vector<Edge>& edges) {
  const Edge* edge = largest_v(span, edges);
  if (edge == nullptr || span.v(*edge) <= kFreeV) return std::nullopt;
  return with_loss(*edge, span.v(*edge));
}

double edge_loss(const Span& span, const std::vector<Edge>& edges) {
  const auto edge = costly_edge(span, edges);
  return edge ? edge->loss_db : 0;
}

/// The main edge, the one before it and the one behind it, as far as they cost anything.
std::vector<DiffractionEdge> deygout_edges(const Span& span, const std::vector<Edge>& edges) {
  const auto main = costly_edge(span, edges);
  if (!main) return {};
  Span first = span, second = span;
  first.b = second.a = *largest_v(span, edges);
  std::vector<DiffractionEdge> found = {*main};
  for (const Span& part : {first, second})
    if (const auto edge = costly_edge(part, edges)) found.push_back(*edge);
  return found;
}

double deygout(const Span& span, const std::vector<DiffractionEdge>& found) {
  if (found.empty()) return 0;
  double others = 0;
  for (std::size_t i = 1; i < found.size(); ++i) others += found[i].loss_db;
  const double of_main = found.front().loss_db, correction = 10 + 0.04 * span.length();
  return of_main + (1 - std::exp(-of_main / 6)) * (others + correction);
}

/// Elevation angle of something `rise_m` higher at d km over the curved Earth, mrad: P.452-17 equation (152).
double elevation_mrad(double rise_m, double d, double curvature) {
  return 1000 * std::atan(rise_m / (1000 * d) - curvature * d / 2);
}

void require(bool condition, const char* what) {
  if (!condition) throw InputError(what);
}

void require_valid(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  require(profile.length_m > 0, "diffraction: the path has no length");
  require(std::isfinite(path.frequency_ghz) && path.frequency_ghz > 0, "diffraction: the frequency must be positive");
  require(path.effective_earth_km > 0, "diffraction: the effective Earth radius must be positive");
  require(path.over_sea >= 0 && path.over_sea <= 1, "diffraction: the share over sea must be from 0 to 1");
  require(profile.points.size() >= 2 && profile.points.front().distance_m == 0 &&
              profile.points.back().distance_m == profile.length_m,
          "diffraction: there is no ground at an end of the path");
  require(antennas.from_m >= profile.points.front().ground_m && antennas.to_m >= profile.points.back().ground_m,
          "diffraction: an antenna is below its ground");
}

}  // namespace

double clutter_top_m(const Profile& profile, const ProfilePoint& point) {
  return point.ground_m + (from_end(profile, point) > kClutterFreeM - kHairM ? point.clutter_m : 0);
}

double effective_earth_km(const Earth& earth) {
  return 1 / (2 * earth.drop_coefficient()) / 1000;
}

double free_space_loss_db(double distance_m, double wavelength) {
  return 20 * std::log10(4 * std::numbers::pi * distance_m / wavelength);
}

double knife_edge_loss_db(double v) {
  if (v <= kFreeV) return 0;
  return 6.9 + 20 * std::log10(std::sqrt((v - 0.1) * (v - 0.1) + 1) + v - 0.1);
}

double bullington_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path, bool smooth) {
  return bullington(whole_span(profile, antennas, path),
                    edges_of(profile, smooth ? Ground::kSmooth : Ground::kWithClutter));
}

double deygout_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  const Span span = whole_span(profile, antennas, path);
  return deygout(span, deygout_edges(span, edges_of(profile, Ground::kWithClutter)));
}

SmoothHeights smooth_heights(const Profile& profile, const Antennas& antennas) {
  const double d = profile.length_m / 1000, from = profile.points.front().ground_m, to = profile.points.back().ground_m;
  double v1 = 0, v2 = 0;  // equations (161), (162)
  for (std::size_t i = 1; i < profile.points.size(); ++i) {
    const ProfilePoint &p = profile.points[i - 1], &q = profile.points[i];
    const double a = p.distance_m / 1000, b = q.distance_m / 1000;
    v1 += (b - a) * (q.ground_m + p.ground_m);
    v2 += (b - a) * (q.ground_m * (2 * b + a) + p.ground_m * (b + 2 * a));
  }
  SmoothHeights heights{(2 * v1 * d - v2) / (d * d), (v2 - v1 * d) / (d * d), 0, 0};
  double highest = 0, towards_t = 0, towards_r = 0;  // equations (165a) to (165d), as far as they are positive
  for (const Edge& e : edges_of(profile, Ground::kBare)) {
    const double above = e.height_m - (antennas.from_m * (d - e.km) + antennas.to_m * e.km) / d;
    highest = std::max(highest, above);
    towards_t = std::max(towards_t, above / e.km);
    towards_r = std::max(towards_r, above / (d - e.km));
  }
  const double share = highest > 0 ? towards_t / (towards_t + towards_r) : 0;
  heights.hstd_m = std::min(heights.hst_m - highest * share, from);
  heights.hsrd_m = std::min(heights.hsr_m - highest * (1 - share), to);
  return heights;
}

Horizons horizons(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  const Span span = whole_span(profile, antennas, path);
  const std::vector<Edge> edges = edges_of(profile, Ground::kBare);
  const double d = span.length(), ce = span.curvature;
  Horizons result;
  result.theta_t_mrad = elevation_mrad(antennas.to_m - antennas.from_m, d, ce);
  result.theta_r_mrad = elevation_mrad(antennas.from_m - antennas.to_m, d, ce);
  if (const Edge* edge = largest_v(span, edges)) result.dlt_km = edge->km, result.dlr_km = d - edge->km;
  double to_r = -std::numeric_limits<double>::infinity();
  Horizons beyond{true, to_r, to_r, {}, {}};
  for (const Edge& e : edges) {
    const double theta_t = elevation_mrad(e.height_m - antennas.from_m, e.km, ce);
    if (theta_t > beyond.theta_t_mrad) beyond.theta_t_mrad = theta_t, beyond.dlt_km = e.km;
    const double theta_r = elevation_mrad(e.height_m - antennas.to_m, d - e.km, ce);
    if (theta_r >= beyond.theta_r_mrad) beyond.theta_r_mrad = theta_r, beyond.dlr_km = d - e.km;
  }
  return beyond.theta_t_mrad > result.theta_t_mrad ? beyond : result;  // equation (150)
}

PathLosses path_losses(const Profile& profile, const Antennas& antennas, const RadioPath& path, const Profile* bare) {
  require_valid(profile, antennas, path);
  const Span span = whole_span(profile, antennas, path);
  const std::vector<Edge> edges = edges_of(profile, Ground::kWithClutter);
  PathLosses losses;
  losses.horizons = horizons(profile, antennas, path);
  losses.smooth = smooth_heights(bare != nullptr ? *bare : profile, antennas);
  losses.free_space_db =
      free_space_loss_db(std::hypot(profile.length_m, antennas.to_m - antennas.from_m), span.wavelength);
  if (const Edge* edge = largest_v(span, edges)) losses.largest_v = span.v(*edge);
  losses.knife_edge_db = edge_loss(span, edges);
  losses.deygout = deygout_edges(span, edges);
  losses.deygout_db = deygout(span, losses.deygout);
  if (!edges.empty() && bullington_edge(span, edges).v > kFreeV) losses.bullington = bullington_edge(span, edges);
  losses.lba_db = bullington(span, edges);
  // Equations (38a, 38b): the antennas above the smooth surface.
  const Antennas above{antennas.from_m - losses.smooth.hstd_m, antennas.to_m - losses.smooth.hsrd_m};
  losses.lbs_db = bullington_loss_db(profile, above, path, true);
  losses.ldsph_db = spherical_earth_loss_db(span.length(), above.from_m, above.to_m, path);
  losses.ld_db = losses.lba_db + std::max(losses.ldsph_db - losses.lbs_db, 0.0);  // equation (40)
  return losses;
}

Profile with_spacing(const Profile& profile, double most_m) {
  Profile dense = profile;
  dense.points.clear();
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    dense.points.push_back(profile.points[i]);
    if (i + 1 == profile.points.size() || !profile.joined(i)) continue;
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    const int parts = static_cast<int>(std::ceil((b.distance_m - a.distance_m) / most_m));
    for (int part = 1; part < parts; ++part) {
      const double t = static_cast<double>(part) / parts;
      const auto between = [t](double p, double q) { return p + (q - p) * t; };
      ProfilePoint p = a;
      p.theme = profile.theme_between(i);
      p.distance_m = between(a.distance_m, b.distance_m);
      p.x = between(a.x, b.x), p.y = between(a.y, b.y);
      p.ground_m = between(a.ground_m, b.ground_m), p.clutter_m = between(a.clutter_m, b.clutter_m);
      dense.points.push_back(p);
    }
  }
  return dense;
}

}  // namespace itin::profile
