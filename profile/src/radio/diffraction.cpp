#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <itin/diffraction.hpp>
#include <itin/error.hpp>
#include <profile/diffraction.hpp>

namespace itin::profile {

namespace {

// The rounding error, in metres, of kilometres in decimals: a point given 50 m from an end is not nearer.
constexpr double kHairM = 1e-6;

enum class Ground { kBare, kWithClutter };

double from_end(const Profile& profile, const ProfilePoint& p) {
  return std::min(p.distance_m, profile.length_m - p.distance_m);
}

std::vector<PathPoint> points_of(const Profile& profile, Ground ground) {
  std::vector<PathPoint> points;
  points.reserve(profile.points.size());
  for (const ProfilePoint& p : profile.points)
    points.push_back({p.distance_m, ground == Ground::kWithClutter ? clutter_top_m(profile, p) : p.ground_m});
  return points;
}

std::vector<PathEdge> edges_of(const Profile& profile, Ground ground) {
  return itin::edges_of(points_of(profile, ground), profile.length_m);
}

PathEnds path_ends(const Profile& profile, const Antennas& antennas) {
  return {profile.length_m, antennas.from_m, antennas.to_m};
}

SmoothHeights smooth_heights(const SmoothEnds& ends) {
  return {ends.hst_m, ends.hsr_m, ends.hstd_m, ends.hsrd_m};
}

/// Returns an edge; nothing where it costs nothing.
std::optional<DiffractionEdge> costly(const PathEdge& edge, double v) {
  if (v <= kFreeV) return std::nullopt;
  return DiffractionEdge{edge.km * 1000, edge.height_m, v, knife_edge_db(v)};
}

/// Returns the edge with the largest v, if it costs anything.
std::optional<DiffractionEdge> costly_edge(const PathSpan& span, const std::vector<PathEdge>& edges) {
  const PathEdge* edge = largest_v(span, edges);
  return edge == nullptr ? std::nullopt : costly(*edge, span.v(*edge));
}

/// Returns the main edge, which has the largest v, the one before it and the one behind it, so far as they cost
/// anything.
std::vector<DiffractionEdge> deygout_edges(const PathSpan& span, const std::vector<PathEdge>& edges,
                                           const PathEdge* main) {
  const auto of_main = main == nullptr ? std::nullopt : costly(*main, span.v(*main));
  if (!of_main) return {};
  PathSpan first = span, second = span;
  first.b = second.a = *main;
  std::vector<DiffractionEdge> found = {*of_main};
  for (const PathSpan& part : {first, second})
    if (const auto edge = costly_edge(part, edges)) found.push_back(*edge);
  return found;
}

double deygout(const PathSpan& span, const std::vector<DiffractionEdge>& found) {
  if (found.empty()) return 0;
  double others = 0;
  for (std::size_t i = 1; i < found.size(); ++i) others += found[i].loss_db;
  const double of_main = found.front().loss_db, correction = 10 + 0.04 * span.length();
  return of_main + (1 - std::exp(-of_main / 6)) * (others + correction);
}

/// The slope towards something `rise_m` higher at d km over the curved Earth, by which the elevation angle of P.452-17
/// equation (152) is found.
double slope_to(double rise_m, double d, double curvature) {
  return rise_m / (1000 * d) - curvature * d / 2;
}
double elevation_mrad(double slope) {
  return 1000 * std::atan(slope);
}

/// The steepest of slopes, and its distance. An angle rises with its slope, so angles are computed only for slopes that
/// may have the largest.
struct Horizon {
  double mrad = -std::numeric_limits<double>::infinity();
  double km = 0;

  /// Considers a slope; `wins_ties` tells whether it wins over an equal angle before.
  void consider(double slope, double at_km, bool wins_ties) {
    constexpr double kSlopeRounding = 1e-12;
    if (slope < steepest - kSlopeRounding) return;
    steepest = std::max(steepest, slope);
    const double angle = elevation_mrad(slope);
    if (angle > mrad || (wins_ties && angle == mrad)) mrad = angle, km = at_km;
  }

 private:
  double steepest = -std::numeric_limits<double>::infinity();
};

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

double free_space_loss_db(double distance_m, double wavelength) {
  return free_space_db(distance_m, wavelength);
}

double knife_edge_loss_db(double v) {
  return knife_edge_db(v);
}

double bullington_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path, bool smooth) {
  const std::vector<PathEdge> edges = edges_of(profile, Ground::kWithClutter);
  return bullington_db(PathSpan(path_ends(profile, antennas), path), smooth ? levelled(edges) : edges);
}

double spherical_earth_loss_db(double distance_km, double from_height_m, double to_height_m, const RadioPath& path) {
  return spherical_earth_db(distance_km, from_height_m, to_height_m, path);
}

double deygout_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  const PathSpan span(path_ends(profile, antennas), path);
  const std::vector<PathEdge> edges = edges_of(profile, Ground::kWithClutter);
  return deygout(span, deygout_edges(span, edges, largest_v(span, edges)));
}

SmoothHeights smooth_heights(const Profile& profile, const Antennas& antennas) {
  return smooth_heights(smooth_ends(points_of(profile, Ground::kBare), path_ends(profile, antennas)));
}

Horizons horizons(const Profile& profile, const Antennas& antennas, const RadioPath& path) {
  const PathSpan span(path_ends(profile, antennas), path);
  const std::vector<PathEdge> edges = edges_of(profile, Ground::kBare);
  const double d = span.length(), ce = span.curvature;
  Horizons result;
  result.theta_t_mrad = elevation_mrad(slope_to(antennas.to_m - antennas.from_m, d, ce));
  result.theta_r_mrad = elevation_mrad(slope_to(antennas.from_m - antennas.to_m, d, ce));
  if (const PathEdge* edge = largest_v(span, edges)) result.dlt_km = edge->km, result.dlr_km = d - edge->km;
  Horizon of_t, of_r;
  for (const PathEdge& e : edges) {
    of_t.consider(slope_to(e.height_m - antennas.from_m, e.km, ce), e.km, false);
    of_r.consider(slope_to(e.height_m - antennas.to_m, d - e.km, ce), d - e.km, true);
  }
  if (edges.empty() || of_t.mrad <= result.theta_t_mrad) return result;  // equation (150)
  return {true, of_t.mrad, of_r.mrad, of_t.km, of_r.km};
}

PathLosses path_losses(const Profile& profile, const Antennas& antennas, const RadioPath& path, const Profile* bare) {
  require_valid(profile, antennas, path);
  const PathEnds ends = path_ends(profile, antennas);
  const PathSpan span(ends, path);
  const std::vector<PathPoint> tops = points_of(profile, Ground::kWithClutter);
  const std::vector<PathEdge> edges = itin::edges_of(tops, profile.length_m);
  PathLosses losses;
  losses.horizons = horizons(profile, antennas, path);
  losses.free_space_db = free_space_db(std::hypot(profile.length_m, antennas.to_m - antennas.from_m), span.wavelength);
  const PathEdge* const main = largest_v(span, edges);
  if (main != nullptr) losses.largest_v = span.v(*main);
  losses.deygout = deygout_edges(span, edges, main);
  if (!losses.deygout.empty()) losses.knife_edge_db = losses.deygout.front().loss_db;
  losses.deygout_db = deygout(span, losses.deygout);
  const DeltaBullington delta =
      delta_bullington(tops, points_of(bare != nullptr ? *bare : profile, Ground::kBare), ends, path);
  losses.smooth = smooth_heights(delta.smooth);
  if (delta.edge) losses.bullington = costly(delta.edge->edge, delta.edge->v);
  losses.lba_db = delta.lba_db, losses.lbs_db = delta.lbs_db;
  losses.ldsph_db = delta.ldsph_db, losses.ld_db = delta.ld_db;
  return losses;
}

Profile with_spacing(const Profile& profile, double most_m) {
  Profile dense = profile;
  dense.points.clear();
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    dense.points.push_back(profile.points[i]);
    if (i + 1 == profile.points.size() || !profile.joined(i)) continue;
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    for_each_place_between(a.distance_m, b.distance_m, most_m, [&](double t) {
      const auto between = [t](double p, double q) { return p + (q - p) * t; };
      ProfilePoint p = a;
      p.theme = profile.theme_between(i);
      p.distance_m = between(a.distance_m, b.distance_m);
      p.x = between(a.x, b.x), p.y = between(a.y, b.y);
      p.ground_m = between(a.ground_m, b.ground_m), p.clutter_m = between(a.clutter_m, b.clutter_m);
      dense.points.push_back(p);
    });
  }
  return dense;
}

}  // namespace itin::profile
