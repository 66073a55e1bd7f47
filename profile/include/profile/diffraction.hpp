// Losses of a radio path over a profile: free space, knife edges, and delta-Bullington with its smooth and spherical
// parts, every intermediate value included. Further, the edges that they were computed from, the point of reflection,
// and the budget of a link with these losses.
//
//   profile::RadioPath path;
//   path.frequency_ghz = 2.5;
//   const profile::PathLosses losses = profile::path_losses(line, {619, 538}, path);  // elevations of the antennas
//   std::cout << losses.free_space_db + losses.ld_db << " dB\n";
//   const profile::BudgetQuery radios{.power_dbm = 20, .from_gain_dbi = 34, .to_gain_dbi = 34, .sensitivity_dbm = -75};
//   const profile::LinkBudget budget = profile::link_budget(losses, path, {line.length_m, {619, 538}}, radios);
//   std::cout << budget.level_dbm << " dBm, " << *budget.margin_db << " dB to spare\n";
//
// Sources: ITU-R P.525-4 (free space), P.526-15 section 4.1 (knife edge), P.452-17 section 4.2 and attachment 2, which
// P.1812-6 section 4.3 and its attachment 1 repeat word for word (delta-Bullington), P.526-12 section 4.4.2 (cascaded
// edges after Deygout). As in these, distances in formulas are km, heights m, frequencies GHz. The wavelength is
// 0.299792458 / f throughout, where some published examples have 0.3 / f: that changes losses by less than 0.01 dB.
//
// Clutter is added to the ground for the losses, except nearer than kClutterFreeM to an end (P.452-18); horizons and
// smooth heights use bare ground. Features that stand on a surface are not clutter: like the terrain, they count for
// edges and horizons, and only the smooth heights leave them out. A profile's points are taken as they are: see
// with_spacing().
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/earth.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

using itin::effective_earth_km;
using itin::Polarisation;
using itin::RadioPath;

inline constexpr double kClutterFreeM = 50;
/// The elevation of the obstacle at a point of the profile: its ground and, unless an end is too near, its clutter.
double clutter_top_m(const Profile& profile, const ProfilePoint& point);

/// Free space loss in dB, P.525-4 section 2.3: 20 log10(4 pi d / lambda).
double free_space_loss_db(double distance_m, double wavelength);

/// Knife edge loss in dB, P.526-15 section 4.1, equation (31): J(v) for v > -0.78, 0 otherwise.
double knife_edge_loss_db(double v);

/// Bullington's loss, P.452-17 section 4.2.1 (P.1812-6 section 4.3.1). `smooth` takes all heights as 0, as section
/// 4.2.3 requires. Elevations of the antennas are in metres.
double bullington_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path, bool smooth = false);

/// First-term spherical-Earth loss with its interpolation within the horizon, P.452-17 sections 4.2.2 and 4.2.2.1
/// (P.526-15 section 3.2, P.1812-6 sections 4.3.2 and 4.3.3). Heights are above the smooth surface, in metres.
double spherical_earth_loss_db(double distance_km, double from_height_m, double to_height_m, const RadioPath& path);

/// Deygout's loss with three edges at most: J(vp) + T (J(vt) + J(vr) + C), P.526-12 section 4.4.2 with its empirical
/// (Causebrook-like) correction T = 1 - exp(-J(vp) / 6), C = 10 + 0.04 D. A value to compare with.
double deygout_loss_db(const Profile& profile, const Antennas& antennas, const RadioPath& path);

/// The surface that fits the path best, P.452-17 attachment 2 section 5.1.6 (P.1812-6 attachment 1 section 5.6).
struct SmoothHeights {
  double hst_m = 0, hsr_m = 0;    ///< elevations at the ends, equations (163), (164)
  double hstd_m = 0, hsrd_m = 0;  ///< for diffraction, equations (166), (167)
};
SmoothHeights smooth_heights(const Profile& profile, const Antennas& antennas);

/// The radio horizon of each antenna, P.452-17 attachment 2 sections 4 and 5.1 to 5.3.
struct Horizons {
  bool trans_horizon = false;
  double theta_t_mrad = 0, theta_r_mrad = 0;  ///< elevation angles; in sight, those towards the other antenna
  /// Distances of the horizons from their own ends; in sight, the distances of the point of largest v. Nothing where
  /// the profile has no point between its ends.
  std::optional<double> dlt_km, dlr_km;
};
Horizons horizons(const Profile& profile, const Antennas& antennas, const RadioPath& path);

/// An edge in the way of a path, taken alone between two other edges or the antennas.
struct DiffractionEdge {
  double distance_m = 0, elevation_m = 0;
  double v = 0;        ///< its diffraction parameter, greater than -0.78
  double loss_db = 0;  ///< J(v)
};

struct PathLosses {
  Horizons horizons;
  SmoothHeights smooth;
  std::optional<double> largest_v;  ///< among points, each a knife edge; nothing without a point between the ends
  double free_space_db = 0;         ///< along the slant line between the antennas
  double knife_edge_db = 0;         ///< loss over the point with the largest v, alone
  double lba_db = 0, lbs_db = 0;    ///< Bullington over the ground and over the smooth surface
  double ldsph_db = 0;              ///< spherical Earth
  double ld_db = 0;                 ///< delta-Bullington: lba + max(ldsph - lbs, 0)
  double deygout_db = 0;
  /// The single edge that Bullington puts in place of the terrain, if it costs anything. It lies where the two
  /// horizons' lines meet or, in sight, at the point of the largest v.
  std::optional<DiffractionEdge> bullington;
  /// The edges after Deygout that cost anything: the main one, and the largest in the spans before and behind it.
  std::vector<DiffractionEdge> deygout;
};

/// Computes the losses by P.452-17 section 4.2.3, P.1812-6 section 4.3.4. Throws InputError unless the path's length,
/// the frequency and the radius are positive, the share over sea is within [0, 1], no antenna is below its ground, and
/// the profile has ground at both ends. `bare` is the line's ground without the features on it, for the smooth heights;
/// null where the profile is bare itself.
PathLosses path_losses(const Profile& profile, const Antennas& antennas, const RadioPath& path,
                       const Profile* bare = nullptr);

/// The place where smooth ground reflects a path.
struct Reflection {
  double distance_m = 0;           ///< from the first antenna
  std::optional<double> ground_m;  ///< elevation of what stands at the place; nothing where data is missing
  std::uint16_t theme = 0;         ///< the theme of what stands at the place
  double grazing_deg = 0;          ///< angle between the path and the ground
  double longer_by_m = 0;          ///< how much longer the reflected path is than the direct one
  /// The point that screens the reflected path. It is the place itself where what stands at it rises above the direct
  /// path. Otherwise it is where the profile rises highest above the two straight lines from the antennas to the ground
  /// at the place; nothing where the profile does not rise above them, and where ground_m is nothing.
  std::optional<ProfilePoint> screen;
  double screen_depth_m = 0;  ///< how far the screen rises above the path or the lines; 0 without a screen
};
/// Finds the specular point on the straight surface that fits the ground best (smooth_heights(), hst and hsr) over the
/// effective Earth: the angles of incidence and reflection are equal there. The profile is taken as it is, with no
/// points added: nothing is sampled. Returns nothing where an antenna is below that surface or the antennas do not see
/// each other over it. `bare` is as for path_losses(). O(n).
std::optional<Reflection> reflection(const Profile& profile, const Antennas& antennas, const RadioPath& path,
                                     const Profile* bare = nullptr);

/// How much less an antenna has away from its axis than the gain there, in decibels by degrees of [0, 360).
struct AntennaPattern {
  using Cut = std::vector<std::pair<double, double>>;  ///< ascending in degrees, at least one
  Cut horizontal;                                      ///< clockwise from the axis
  Cut vertical;                                        ///< downwards from the axis
  std::optional<double> gain_dbi = {};                 ///< the one that the file states
  std::optional<double> frequency_mhz = {};            ///< likewise: where the antenna was measured
  std::string path = {};                               ///< the file
};
/// Reads a pattern: MSI (Planet; .msi, .pln), or that of Radio Mobile (.ant; 360, 541 or 720 numbers). Gains without a
/// unit are dBd, as MSI has it. Losses may all have a minus. Throws FileError, and InputError with the line for what is
/// neither.
AntennaPattern read_antenna_pattern(const std::string& path);

/// An antenna with a pattern, and where its axis points.
struct AimedAntenna {
  std::shared_ptr<const AntennaPattern> pattern = {};  ///< null: the gain towards the other end, wherever it is
  std::optional<double> azimuth_deg = {};              ///< from grid north; nothing: towards the other end
  std::optional<double> tilt_deg = {};                 ///< below the horizontal; nothing: towards the other end

  /// Whether nothing of it is known.
  bool empty() const { return !pattern && !azimuth_deg && !tilt_deg; }
};

/// What the budget of a link needs besides its path. What is nothing is left out, and the budget says so.
struct BudgetQuery {
  // The first end sends. One of the two asks for a budget:
  std::optional<double> power_dbm = {};  ///< what the transmitter gives to the feeder
  std::optional<double> eirp_dbm = {};   ///< what the antenna radiates; the first end's gain and feeder are in it

  std::optional<double> from_gain_dbi = {}, to_gain_dbi = {};    ///< nothing: that of the pattern's file, or 0
  std::optional<double> from_feeder_db = {}, to_feeder_db = {};  ///< losses; nothing: 0
  std::optional<double> sensitivity_dbm = {};                    ///< the least level that the receiver works with
  std::optional<double> rain_rate_mm_h = {};         ///< exceeded for 0.01 % of an average year; nothing: no rain
  std::optional<double> geoclimatic_factor = {};     ///< K of P.530-17; nothing: by the gradient
  std::optional<double> refractivity_gradient = {};  ///< dN1 of P.453, N-units per km, negative; nothing: no multipath

  /// Patterns that were measured far from the link's frequency are refused.
  AimedAntenna from_antenna = {}, to_antenna = {};

  bool asks() const { return power_dbm || eirp_dbm; }
  /// Returns the query with what `own` has in place of what this one has. A power takes the place of an EIRP, and an
  /// EIRP that of a power and of the first end; likewise the factor and the gradient.
  BudgetQuery with(const BudgetQuery& own) const;
  /// Throws InputError for what contradicts itself, for values that none can have, and for what works only with a power
  /// where there is none.
  void validate() const;
};

/// The line that a budget is for.
struct BudgetCourse {
  double length_m = 0;
  Antennas antennas = {};                   ///< elevations
  std::optional<double> azimuth_deg = {};   ///< from the first end to the second, from grid north
  std::optional<double> latitude_deg = {};  ///< the middle's; nothing: the year fades as the worst month does
};

/// Attenuation by rain, P.838-3 and P.530-18 section 2.4.1.
struct RainLoss {
  double specific_db_km = 0;  ///< over a kilometre of rain of the rate given
  double effective_km = 0;    ///< the length that rain of this rate would have to cover
  double exceeded_db = 0;     ///< what is exceeded for 0.01 % of an average year
};
/// Multipath fading in clear air, P.530-17 section 2.3, its method for quick planning.
struct MultipathFading {
  double geoclimatic_factor = 0;              ///< K
  double occurrence_percent = 0;              ///< p0, of the average worst month; 0 up to 5 km
  std::optional<double> worst_month_percent;  ///< the part with fades deeper than the margin; nothing without one
};
/// The part of an average year in which a link is out.
struct Outage {
  double percent = 0;
  bool at_most = false;  ///< whether it may be less, because a formula ends there
};
struct Availability {
  double percent = 0;         ///< the part of an average year
  double outage_minutes = 0;  ///< in a year of 365.25 days
  bool at_least = false;      ///< whether it may be more, because a formula ends there
};

struct LinkBudget {
  double eirp_dbm = 0;                              ///< on the axis of the antenna
  double from_gain_dbi = 0, to_gain_dbi = 0;        ///< on the axes; the first is 0 where it is in the EIRP
  double from_off_axis_db = 0, to_off_axis_db = 0;  ///< what is lost because the other end is not on the axis
  double free_space_db = 0, diffraction_db = 0;
  std::optional<double> gases_db;   ///< P.676-13, air of 1013.25 hPa, 15 degrees Celsius, 7.5 g of vapour per m3
  double level_dbm = 0;             ///< at the receiver, in clear air
  std::optional<double> margin_db;  ///< the level over the sensitivity, for fades; nothing without a sensitivity
  std::optional<RainLoss> rain;
  std::optional<Outage> rain_outage;
  std::optional<MultipathFading> multipath;
  std::optional<Outage> multipath_outage;
  std::optional<Availability> availability;  ///< the outages by rain and by multipath added, so far as they are known
  std::vector<std::string> left_out;         ///< what is not counted, and why: "rain (no rate is given)"
};
/// What no budget counts, in words.
inline constexpr const char* kNeverInBudgets =
    "interference, selective fading, cross-polarisation, diversity, wet antennas, misaligned antennas";

/// Adds up a link. Outside of the ranges of their recommendations, gases, rain and multipath are left out. Throws what
/// validate() throws, and InputError where neither the query nor the file of a pattern has the gain, and where an
/// antenna has an azimuth but the course has none. Precondition: the query asks for a budget.
LinkBudget link_budget(const PathLosses& losses, const RadioPath& path, const BudgetCourse& course,
                       const BudgetQuery& query);

/// Adds points until no two neighbours are farther apart than `most_m`, in metres. A triangulated surface is straight
/// between breakpoints, but the Earth below it is not, and the formulas look at points only.
Profile with_spacing(const Profile& profile, double most_m);

}  // namespace itin::profile
