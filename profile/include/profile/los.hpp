// Computes everything that a report says about one line of sight, over a store or on a profile.
//
//   profile::LosQuery query;
//   query.from_height_m = 12, query.to_height_m = 15, query.earth = Earth::effective_earth(4.0 / 3);
//   query.radio = profile::RadioPath{.frequency_ghz = 7.5, .effective_earth_km = 6371 * 4.0 / 3};
//   query.criteria = {{4.0 / 3, 1.0}, {2.0 / 3, 0.3}};
//   const profile::StoreLine hills{.from = {310375, 183525}, .to = {322300, 190000}, .themes = ThemeChoice::all()};
//   const profile::LosReport report = profile::analyse(store, hills, query);
//   std::cout << profile::name_of(report.verdict) << '\n';
//   profile::write_report(report, "{}", "link.pdf", false);
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/feature_at.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <profile/diffraction.hpp>
#include <profile/fresnel.hpp>
#include <profile/profile.hpp>
#include <profile/required_heights.hpp>

namespace itin::profile {

struct MapSheet;

enum class SightVerdict { kVisible, kHidden, kUndecided };
/// The verdict on a criterion. The certified error of a coarse surface, or ground without data, leaves it undecided.
enum class CriterionVerdict { kMeets, kFails, kUndecided };
using itin::NoData;
const char* name_of(SightVerdict verdict);
const char* name_of(CriterionVerdict verdict);

/// A stretch of ground above the ray, from where the ray enters it to where it leaves.
struct Obstruction {
  double from_m = 0, to_m = 0;  ///< distances
  double peak_at_m = 0;         ///< where it is deepest
  double peak_m = 0;            ///< elevation of the ground at that distance
  double depth_m = 0;           ///< how far the ray lies below the ground at that distance, > 0
  std::uint16_t theme = 0;      ///< the theme of what stands at peak_at_m
  std::int64_t feature = -1;    ///< as in ProfilePoint
};

/// A rule of two-criterion planning: on an Earth of factor k, this fraction of F1 must be clear.
struct Criterion {
  double k = 4.0 / 3;
  double fraction = 1;
  bool fade = false;  ///< whether fade_factor() of the line's length takes the place of k

  friend bool operator==(const Criterion&, const Criterion&) = default;
};
/// The effective Earth factor that is exceeded for 99.9 % of the worst month on a path of this length. With d as its
/// kilometres, ke = 157 / (144 + 2670 / d), after the curve of ITU-R P.530 section 2.2. The curve begins at
/// kShortestFade; shorter paths have the factor of that length, for the formula goes to 0 with the length. The formula
/// has not been confirmed from the recommendation's text.
double fade_factor(double length_m);
inline constexpr double kShortestFade = 10000;  ///< metres
struct CriterionResult {
  Criterion criterion;
  double k = 0;  ///< the effective Earth factor by which it was judged
  CriterionVerdict verdict = CriterionVerdict::kMeets;
  // The following are over known ground on this Earth.
  std::optional<double> clearance_m;     ///< at the critical point
  std::optional<double> clearance_f1;    ///< least ratio to F1; nothing without a frequency
  std::optional<double> margin_f1;       ///< how much of F1 that leaves beyond the fraction wanted; negative: it lacks
  std::optional<double> margin_f1_at_m;  ///< the distance at which it does
  /// Negative: the greatest lack of metres along the line. Otherwise the metres left where the ratio to F1 is least,
  /// and for a fraction of 0 the clearance at the critical point.
  std::optional<double> margin_m;
  std::optional<double> margin_at_m;  ///< the distance of the place of margin_m
};
struct NamedHeights {
  std::string name = {};  ///< "line of sight", "0.6 F1", "K = 1.333, 1 F1"
  double k = 0;           ///< effective Earth factor; infinity without curvature
  double fraction = 0;
  RequiredHeights heights = {};
  std::vector<HeightPair> curve = {};  ///< ascending in from_m, descending in to_m
};

struct LosQuery {
  double from_height_m = 0, to_height_m = 0;  ///< above what the ends stand on
  /// Whether an end within a raised feature stands on the feature, or else on the ground under it.
  bool from_on_surface = false, to_on_surface = false;
  Earth earth = {};
  std::optional<RadioPath> radio = {};
  BudgetQuery budget = {};                ///< asks for something only if there is a frequency
  std::vector<Criterion> criteria = {};   ///< with fraction > 0 only if there is a frequency
  std::optional<TallObject> object = {};  ///< at the second end
  /// How far, in metres, the clearance over the full surface may lie from the one on this profile: the width of the
  /// surface's certified error. A clearance nearer to 0 leaves the verdict undecided.
  double clearance_error_m = 0;
  NoData nodata = NoData::kUnknown;
  /// Whether the losses take the profile's points alone, as published cases do. Otherwise points are added on the
  /// straight ground between them, at most 100 m and a 50th of the length apart.
  bool points_as_given = false;
  /// The day of the magnetic azimuths of a line over a store.
  std::optional<std::chrono::year_month_day> day = {};
};

/// The course of a line over a store, and the surface that it runs over.
struct StoreLine {
  Point2 from = {}, to = {};                 ///< in the store's CRS
  Detail detail = Detail::tolerance(0);      ///< the surface's level of detail
  ThemeChoice themes = ThemeChoice::none();  ///< raised features on the surface
  /// Whether the query's height of an end is an elevation, not a height above what the end stands on.
  bool from_is_elevation = false, to_is_elevation = false;
};

/// One end of a line, so far as it is known: a profile from a file has no positions.
struct LosEnd {
  double ground_m = 0;              ///< elevation of the ground without raised features
  std::optional<double> surface_m;  ///< elevation with raised features, where they are known
  bool on_surface = false;          ///< whether height_m counts from surface_m
  double height_m = 0;              ///< the antenna's height
  double elevation_m = 0;           ///< the antenna's elevation
  double elevation_angle_deg = 0;   ///< the angle at which the other antenna appears
  struct Site {
    Point2 position;                                    ///< in the store's CRS
    Point2 lon_lat;                                     ///< degrees on WGS 84; on another body, on its own ellipsoid
    double azimuth_grid_deg = 0, azimuth_true_deg = 0;  ///< towards the other end
    /// The azimuth from magnetic north, which lies `declination_deg` east of true north (World Magnetic Model 2025).
    /// Nothing without a day, on a day outside 2025 to 2029, and close to the magnetic poles.
    std::optional<double> azimuth_magnetic_deg, declination_deg;
  };
  std::optional<Site> site;
};

/// The judgement on a ray over a profile.
struct LineFindings {
  SightVerdict verdict = SightVerdict::kVisible;
  SightVerdict known_verdict = SightVerdict::kVisible;  ///< over known ground alone
  /// The point where the ray is cut deepest or, if it is free, where its clearance is the least fraction of the Fresnel
  /// zone (of any frequency): never the foot of a mast that stands free. Nothing where no ground lies between the ends.
  std::optional<ProfilePoint> critical;
  std::optional<double> clearance_m;  ///< at the critical point; negative where the ray is cut
  /// The point where the ray is least above the surface, the feet of the antennas included.
  std::optional<ProfilePoint> lowest;
  std::optional<double> least_clearance_m;  ///< at the lowest point
  std::vector<Obstruction> obstructions;
  std::vector<CriterionResult> criteria;
  std::vector<NamedHeights> required;
  std::optional<FresnelClearance> fresnel;  ///< nothing without a frequency, and as fresnel_clearance() tells
};

/// The report on a line. Its findings are about all that stands on the ground, clutter included.
struct LosReport : LineFindings {
  LosQuery query;
  Profile profile;                   ///< with raised features, clutter among them
  Profile ground;                    ///< without raised features; no points where the profile has none either
  std::optional<LineFindings> bare;  ///< over the ground without the profile's clutter, where it has any
  EndGrounds stands_on;              ///< elevations of what the ends stand on
  Antennas antennas;                 ///< elevations
  LosEnd from, to;
  std::optional<PathLosses> losses;  ///< nothing without a frequency or a length, or with an antenna within a feature
  std::optional<LinkBudget> budget;  ///< nothing without `losses`, and where none is asked for
  std::optional<Reflection> reflection;  ///< nothing without a frequency, and where there is none
  std::optional<VisibleHeight> visible;

  // These are for the report's header and maps. Over a store analyse() fills in all but the title, otherwise the caller
  // does.
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< the input and the settings: name, value
  std::string from_name = "A", to_name = "B";              ///< what maps call the ends
  std::vector<std::string> from_lines, to_lines;           ///< about the ends
  std::string crs_wkt;                                     ///< empty: the profile has no positions
  std::optional<double> geodesic_m;    ///< on WGS 84 or the body's own, where the ends have positions
  std::vector<std::string> themes;     ///< names by ProfilePoint::theme; 0 is the terrain
  std::vector<ThemeKind> theme_kinds;  ///< by ProfilePoint::theme - 1; only over a store
  std::map<std::pair<std::uint16_t, std::int64_t>, FeatureAt> features;  ///< by theme and feature
  /// The spacing, in metres, of the rows of the printed profile; nothing: about 30 rows; 0: no such table.
  std::optional<double> table_spacing_m;
  /// The map of where the line runs, as viewshed::location_map() makes it; null: the report has none.
  std::shared_ptr<const MapSheet> location;

  // These are known only for a line over a store:
  std::vector<SourceInfo> sources;  ///< the surface's under the line, as triangulated along it
  RetrievalStatistics statistics;
  std::uint64_t triangles = 0;  ///< crossed by the line
};

/// The elevation under each end, of the surface or of the ground as the query says.
EndGrounds stands_on(const Profile& profile, const Profile& ground, const LosQuery& query);

/// Analyses a line over a profile. `ground` is the same line without raised features, for a profile that has them. The
/// clutter of a profile without `ground` stands on that profile, except nearer to an end than kClutterFreeM. Throws
/// InputError where there is no ground at an end, a height is negative, or a criterion asks for a part of the Fresnel
/// zone without a frequency, and what BudgetQuery::validate() throws. O(n) except for logarithmic factors.
LosReport analyse(Profile profile, const LosQuery& query, Profile ground = {});

/// Finds what analyse() finds on a profile without clutter, except obstructions and required heights: whether a line is
/// free, in a small part of the time. Throws what analyse() throws.
LineFindings judge(const Profile& profile, const LosQuery& query, const Profile& ground = {});

/// Analyses a line over a store, with what stands on its ground. The surface's certified error about the line is added
/// to query.clearance_error_m, so that over a coarse surface a verdict is certain or undecided. The report's query has
/// the sum, and heights above what the ends stand on. Throws what the other analyse() throws, InputError also for an
/// elevation below what its end stands on, for themes that the store does not have, and for an end that has no
/// longitude and latitude; CorruptStore, FileError.
LosReport analyse(const Store& store, const StoreLine& line, LosQuery query);

/// The JSON document that `itin los --json` prints, without the call and its outputs. The first is for a profile; the
/// second is for a line over a store, and tells what was read of it.
std::string json_of(const LosReport& report);
std::string json_of(const Store& store, const StoreLine& line, const LosReport& report);

/// The position at a distance along the line, in the profile's CRS.
Point2 position_at(const LosReport& report, double distance_m);

/// Elevation of the ray at a distance, both in metres; a straight line in the drawing's effective Earth.
double ray_elevation_m(const LosReport& report, double distance_m);

/// Returns "terrain", or the theme's name with the name of a known feature: "buildings, Town Hall".
std::string cause_of(const LosReport& report, std::uint16_t theme, std::int64_t feature = -1);

/// Writes a report as a file that a planner can hand in. The name's ending gives the format:
/// - .json: the document as given
/// - .csv: one row for each point of the profile
/// - .txt: the profile for other programs: distance km, ground m, height of what stands there m, its kind (T
///   vegetation, B anything else, N nothing)
/// - .svg, .pdf, .png: the drawing; the PDF has more pages, which are numbered: the map of where the line runs, the
///   drawing over the Earth of the worst fade that a criterion asks about, tables, the trade-off chart, the profile as
///   a table
/// - .html: all of it, self-contained
/// - .kml and .gpkg: the line, its ends, the critical point, the point of reflection, the edges and the obstructions;
///   for profiles with positions
/// Equal reports give equal bytes. Throws what require_report() throws, and FileError.
void write_report(const LosReport& report, const std::string& json, const std::string& path, bool overwrite);

/// Whether a report of this ending shows LosReport::location: a .pdf or a .html does.
bool shows_location(const std::string& path);

/// Throws InputError for another ending, and for .kml and .gpkg of a profile without positions.
void require_report_format(const std::string& path, bool has_positions);
/// Throws InputError as require_report_format() does, and for a .txt of a profile with gaps, and for a
/// `table_spacing_m` that is negative, or that would give the line more than 10,000 rows.
void require_report(const LosReport& report, const std::string& path);

}  // namespace itin::profile
