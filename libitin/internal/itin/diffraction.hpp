// The loss of a radio path by diffraction over a profile. This is the one place where it is computed, for single lines,
// for many links and for viewsheds (law 4).
//
//   const PathEnds ends{12000, 120.5, 98};
//   const DeltaBullington loss = delta_bullington(tops, ground, ends, {.frequency_ghz = 2.5});
//   std::cout << loss.ld_db << " dB\n";
//
// Sources: P.525-4 section 2.3 (free space), P.526-15 section 4.1 (knife edge), P.452-17 section 4.2 and attachment 2,
// which P.1812-6 section 4.3 and its attachment 1 repeat word for word (delta-Bullington). Equation numbers are those
// of P.452-17. Formulas look at points only, and take distances in km, heights in m, frequencies in GHz.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <itin/earth.hpp>

namespace itin {

/// A point of a profile, metres. The points are in order of distance, from one end of the path to the other.
struct PathPoint {
  double distance_m = 0;
  double height_m = 0;
};

/// The ends of a path: how far apart they are, and the elevations of the antennas.
struct PathEnds {
  double length_m = 0;
  double from_m = 0, to_m = 0;
};

/// Returns the ends with antennas that rounding has put below what they stand on, raised to it; nothing where one is
/// within what stands there.
std::optional<PathEnds> above_tops(PathEnds ends, double from_top_m, double to_top_m);

/// A point strictly between the ends.
struct PathEdge {
  double km = 0;
  double height_m = 0;
};
std::vector<PathEdge> edges_of(std::span<const PathPoint> profile, double length_m);
/// Puts all edges on the smooth surface itself, as section 4.2.3 has it.
std::vector<PathEdge> levelled(std::vector<PathEdge> edges);

/// The stretch between two places: antennas, or an edge and an antenna. They need not see each other.
struct PathSpan {
  PathEdge a, b;
  double curvature = 0;   ///< Ce = 1 / ae, 1/km
  double wavelength = 0;  ///< m

  PathSpan() = default;
  PathSpan(const PathEnds& ends, const RadioPath& path)
      : a{0, ends.from_m},
        b{ends.length_m / 1000, ends.to_m},
        curvature(1 / path.effective_earth_km),
        wavelength(wavelength_m(path.frequency_ghz)) {}

  double length() const { return b.km - a.km; }
  double bulge_m(double d1, double d2) const { return 500 * curvature * d1 * d2; }
  double line_m(double d1, double d2) const { return (a.height_m * d2 + b.height_m * d1) / length(); }
  /// Returns the parameter v of an obstacle `above` metres over the line: equations (16) and (20).
  double v_of(double above, double d1, double d2) const {
    return above * std::sqrt(0.002 * length() / (wavelength * d1 * d2));
  }
  double v(const PathEdge& e) const {
    const double d1 = e.km - a.km, d2 = b.km - e.km;
    return v_of(e.height_m + bulge_m(d1, d2) - line_m(d1, d2), d1, d2);
  }
};

/// Returns the edge strictly inside the span with the largest v, the last of equals; null where there is no edge.
const PathEdge* largest_v(const PathSpan& span, std::span<const PathEdge> edges);

/// Returns 20 log10(4 pi d / lambda): P.525-4 section 2.3; dB.
double free_space_db(double distance_m, double wavelength);

/// Edges whose v is no greater cost nothing: P.526-15 equation (31).
inline constexpr double kFreeV = -0.78;
/// Returns J(v) for v > kFreeV, 0 otherwise; dB.
double knife_edge_db(double v);

/// The single edge that Bullington puts in place of all edges, and its v: equations (16), (18) to (20).
struct BullingtonEdge {
  PathEdge edge;
  double v = 0;
};
/// Returns nothing where there is no edge.
std::optional<BullingtonEdge> bullington_edge(const PathSpan& span, std::span<const PathEdge> edges);

/// Returns Bullington's loss over edges within the span: section 4.2.1; dB. 0 without an edge.
double bullington_db(const PathSpan& span, std::span<const PathEdge> edges);

/// Returns the first-term spherical-Earth loss with its interpolation within the horizon: sections 4.2.2 and 4.2.2.1;
/// dB. Takes heights above the smooth surface, metres.
double spherical_earth_db(double distance_km, double from_height_m, double to_height_m, const RadioPath& path);

/// The surface that fits the ground best: attachment 2 section 5.1.6. Its elevations at both ends, metres.
struct SmoothEnds {
  double hst_m = 0, hsr_m = 0;    ///< equations (163), (164)
  double hstd_m = 0, hsrd_m = 0;  ///< for diffraction, equations (166), (167)
};
/// Fits the smooth surface to the ground. Precondition: there is ground at both ends.
SmoothEnds smooth_ends(std::span<const PathPoint> ground, const PathEnds& ends);

struct DeltaBullington {
  SmoothEnds smooth;
  std::optional<BullingtonEdge> edge;  ///< over the tops
  double lba_db = 0, lbs_db = 0;       ///< Bullington over the tops and over the smooth surface
  double ldsph_db = 0;                 ///< spherical Earth
  double ld_db = 0;                    ///< lba + max(ldsph - lbs, 0): equation (40)
};
/// Computes section 4.2.3. `tops` is the profile that diffracts; `ground` is the one that the smooth surface fits,
/// equal to `tops` where nothing stands on it. Preconditions: both reach from end to end, no antenna is below them, and
/// the length, the frequency and the effective radius are positive.
DeltaBullington delta_bullington(std::span<const PathPoint> tops, std::span<const PathPoint> ground,
                                 const PathEnds& ends, const RadioPath& path);

/// Returns how far apart the points of a path of this length may be at most, metres. A triangulated surface is straight
/// between breakpoints, but the Earth below it is not.
constexpr double greatest_spacing_m(double length_m) {
  constexpr double kMostSpacingM = 100;
  constexpr int kLeastPoints = 50;
  return std::min(kMostSpacingM, length_m / kLeastPoints);
}

/// Calls add(t) for places between two joined points, t of the way from one to the other, as many as are
/// needed to keep neighbours within `most_m` of each other.
template <class Add>
void for_each_place_between(double from_m, double to_m, double most_m, const Add& add) {
  const int parts = static_cast<int>(std::ceil((to_m - from_m) / most_m));
  for (int part = 1; part < parts; ++part) add(static_cast<double>(part) / parts);
}

}  // namespace itin
