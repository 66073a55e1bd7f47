// A study of wind farms in one call: the zone of theoretical visibility, what is seen from viewpoints and along routes,
// what a radar sees, which turbines keep clear of radio links; and its folder of rasters, polygons, tables, wirelines,
// map sheets and a text on methods.
//
//   viewshed::ZoneStudyRequest study_request;
//   study_request.turbines = viewshed::read_turbines({.path = "turbines.csv"}, store.metadata().crs_wkt);
//   study_request.zone.cell_size = 50;
//   const viewshed::ZoneStudy study = viewshed::study_zone(store, study_request, progress);
//   for (const viewshed::ZoneFile& file : viewshed::write_zone_study("ztv", store, study, {}, progress))
//     std::cout << file.name << ": " << file.what << '\n';
//
// turbines.hpp tells what it means that a turbine is seen. Viewpoints and routes count every turbine, however far it
// is. Positions are in the store's CRS, lengths in metres. InputError and warnings name fields between backticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/sheet_choice.hpp>
#include <viewshed/result.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Sizes in metres; two imply the third.
struct TurbineSize {
  std::optional<double> hub = {}, rotor = {}, tip = {};

  /// Completes the size that the other two imply. Throws InputError where the tip stays open, or they contradict each
  /// other.
  void complete();
};

/// How far from a turbine its visibility is assessed.
struct RadiusRule {
  struct Step {
    double tip_up_to_m = std::numeric_limits<double>::infinity();
    double radius_km = 0;
  };
  std::string source = "radii by tip height assumed after UK practice";
  std::vector<Step> steps = {{50, 15},  {70, 20},  {85, 25},         {100, 30},
                             {130, 35}, {150, 40}, {.radius_km = 45}};  ///< ascending, the last open
  std::optional<double> fixed = {};                                     ///< metres, for all turbines instead

  /// Returns the radius, in metres, for a height of tips.
  double radius(double tip_height) const;
};

/// Reads a rule, {"source": ..., "radii": [{"tip_up_to_m": 50, "radius_km": 15}, ..., {"radius_km": 45}]}. Throws
/// FileError.
RadiusRule read_radius_rule(const std::string& path);

/// A row of a file that is not used.
struct BadRow {
  std::size_t number = 0;    ///< from 1, in the file's order
  std::int64_t feature = 0;  ///< the file's own number for it
  std::string place = {};    ///< where it stands in the file: "feature 3"
  std::string message = {};
};

/// A vector file of points, or CSV with columns x,y or lon,lat.
struct PointFile {
  std::string path = {};
  std::string layer = {};       ///< empty: the file's only layer
  std::string where = {};       ///< a condition in OGR's SQL; empty: all
  std::string name_field = {};  ///< empty: `name`, or the only one that seems to hold names
  std::string crs = {};         ///< the CRS of a file that states none; empty: the one asked for
};

/// A file of turbines. Fields that are named otherwise than by default have to be there.
struct TurbineFile {
  std::string path = {}, layer = {}, where = {}, name_field = {}, crs = {};  ///< as in PointFile
  std::string hub_height_field = "hub_height";
  std::string rotor_diameter_field = "rotor_diameter";
  std::string tip_height_field = "tip_height";
  std::string farm_field = "farm";
  std::string status_field = "status";  ///< proposed, consented or existing, in usual words; empty: not asked for
  std::string proposal = {};  ///< the farm that is the proposal: others that are proposed are in planning beside it
  TurbineSize size = {};      ///< taken for turbines whose row leaves it open
  std::string farm = {};      ///< taken for turbines whose row gives none
  RadiusRule radius = {};     ///< gives Turbine::radius
};

/// Turbines, and what there is to say about the file that they come from.
struct TurbineTable {
  std::vector<Turbine> turbines = {};
  std::string path = {};                    ///< empty: the turbines are not from a file
  std::string sha256 = {};                  ///< the checksum of the file
  std::size_t rows = 0;                     ///< how many rows the file has; turbines are numbered by them
  std::vector<std::int64_t> features = {};  ///< the file's own number for each row
  std::vector<std::string> places = {};     ///< likewise: "feature 3"
  std::vector<BadRow> bad = {};
  std::vector<std::string> warnings = {};  ///< about rows that are used, a line each
  std::optional<RadiusRule> radius = {};   ///< the rule of their radii, if there is one
};

/// Reads turbines in the CRS `to_crs` (WKT). Turbine k is the one of row k. Throws FileError; InputError where no row
/// can be used.
TurbineTable read_turbines(const TurbineFile& file, const std::string& to_crs);

/// An eye from which the turbines are looked at.
struct Viewpoint {
  std::size_t number = 0;
  std::string name = {};
  Point2 position = {};
  double height = 0;  ///< how high the eye is above the ground
  double ground = 0;  ///< filled in by study_zone()
};

struct ViewpointTable {
  std::vector<Viewpoint> viewpoints = {};   ///< numbers differ
  std::string path = {};                    ///< empty: the viewpoints are not from a file
  std::size_t rows = 0;                     ///< how many rows the file has
  std::vector<std::int64_t> features = {};  ///< the file's own number for each row
  std::vector<std::string> places = {};     ///< likewise: "feature 3"
  std::vector<BadRow> bad = {};
  std::vector<std::string> warnings = {};
};

/// Reads viewpoints in the CRS `to_crs` (WKT). The field `height` says how high their eyes are; `height`, where it does
/// not. Throws FileError; InputError for a file without viewpoints.
ViewpointTable read_viewpoints(const PointFile& file, const std::string& to_crs, double height = 2);

/// A road or a path.
struct ZoneRoute {
  std::string name = {};             ///< may be empty
  std::vector<Point2> corners = {};  ///< at least two
};

struct RouteTable {
  std::vector<ZoneRoute> routes = {};
  std::string path = {};
  std::vector<std::string> warnings = {};
};

/// Reads the lines of a vector file in the CRS `to_crs` (WKT). Throws FileError, InputError.
RouteTable read_routes(const std::string& path, const std::string& to_crs);

struct ZoneStudyRequest {
  TurbineTable turbines = {};
  /// Cells, observer, surface, Earth, memory and radar. Its turbines are those of the table.
  ZoneRequest zone = {};
  std::string grid_source = {};  ///< names `zone.grid` in messages
  ViewpointTable viewpoints = {};
  RouteTable routes = {};
  double route_step = 100;  ///< the greatest distance between the places along a route that are looked from
  /// Radio links that rotors must stay clear of, in plan, at `frequency_ghz`.
  profile::LinkTable links = {};
  double frequency_ghz = 0;
};

/// The part of one turbine that is seen from one viewpoint.
struct TurbineSight {
  using Verdict = viewshed::Verdict;  ///< kUndecided: ground without data alone leaves it open
  double distance = 0, azimuth = 0;
  Verdict tip = Verdict::kHidden;
  std::optional<Verdict> hub;            ///< nothing: the hub's height is not known
  double visible = 0, vertical_deg = 0;  ///< what is certainly seen: metres from the tip down, degrees
  double tip_deg = 0;
  bool gaps = false;
};

/// What is seen of some turbines together.
struct SightSummary {
  std::size_t turbines = 0, tips = 0;
  std::size_t tips_beyond = 0;      ///< how many of the tips are beyond their turbine's radius, where maps count none
  std::size_t tips_undecided = 0;   ///< in addition to those seen
  std::optional<std::size_t> hubs;  ///< nothing: no hub's height is known
  std::optional<std::size_t> hubs_undecided;
  std::size_t hubs_known = 0;  ///< turbines whose hub height is known
  std::size_t nearest = 0;     ///< index in the request
  double nearest_m = 0;
  std::optional<std::size_t> nearest_seen;
  std::optional<Arc> arc;   ///< the smallest that holds the rotors whose tips are seen
  double vertical_deg = 0;  ///< the greatest vertical angle that the visible part of a turbine takes up
  bool gaps = false;
};

struct StudiedViewpoint {
  Viewpoint viewpoint;
  std::vector<TurbineSight> bare;      ///< one for each turbine of the zone
  std::vector<TurbineSight> screened;  ///< likewise, with features; empty without features
  std::string before_the_eye;          ///< a sentence on what stands there; empty where nothing does
};

struct RoutePlace {
  double distance = 0;  ///< along the route
  Point2 position;
  double ground = 0;                           ///< NaN: none
  std::optional<SightSummary> bare, screened;  ///< nothing where there is no ground; `screened` also without features
};

struct StudiedRoute {
  std::size_t number = 1;
  ZoneRoute route;
  double length = 0;
  std::vector<RoutePlace> places;  ///< each in the middle of one of equally long stretches

  /// Returns the route's name, or "route 3".
  std::string title() const;
};

/// The radio link that is least clear of a turbine's own rotor.
struct LinkClearance {
  std::string link;
  double clearance_m = 0;  ///< negative: the rotor reaches into the second Fresnel zone, in plan
};

struct ZoneStudy {
  ZoneStudyRequest request;  ///< with further bad rows: those without ground
  Zone zone;
  std::vector<StudiedViewpoint> viewpoints;  ///< those on the ground
  std::vector<StudiedRoute> routes;
  std::vector<LinkClearance> link_clearances;  ///< one for each turbine of the zone; empty without links
  MissingGround missing;                       ///< in the study area
  std::vector<SourceInfo> sources;             ///< the sources of the surface that sight lines pass over
  StoreMetadata metadata;
  std::vector<std::string> warnings;  ///< a line each
};

/// Studies the turbines. Throws InputError where the request makes no sense, or no cell lies within the radius of a
/// turbine; also what survey_turbines() throws.
ZoneStudy study_zone(const Store& store, ZoneStudyRequest request, Progress& progress);

/// The JSON document that `itin ztv --json` prints, without the call and its outputs.
std::string json_of(const ZoneStudy& study);

/// Which wirelines are drawn, and how.
struct WirelineChoice {
  bool none = false;                         ///< tables of viewpoints alone
  std::vector<std::string> viewpoints = {};  ///< the names or numbers of those with wirelines; empty: all
  double least_width_deg = 53.5;
  std::optional<double> bearing_deg = {};  ///< where the middle lies; nothing: the turbines' middle
  bool hidden_dashed = false;
  std::optional<double> blade_deg = 0;  ///< how far a blade is turned from upright; nothing: another for each turbine
  std::string alone = {};               ///< sheets in pairs: this farm alone, and all; empty: no pairs
};

struct ZoneFile {
  std::string name;
  std::string what;  ///< one line: quantity, unit, meaning of nodata
};

struct ZoneStudyFileOptions {
  WirelineChoice wirelines = {};
  profile::SheetChoice sheets = {};
  /// Says in methods.md what decides where ground without data leaves something open.
  std::string decides_missing_ground = "nodata = NoData::kBlock or kClear";
  /// Returns the text of ztv.json, given the other files; empty: what json_of() returns, the files and the warnings.
  std::function<std::string(const std::vector<ZoneFile>& files)> manifest = {};
  bool overwrite = false;
};

/// The file that tells a folder of such outputs from any other.
inline constexpr const char* kZoneManifest = "ztv.json";

/// Writes the study into a folder, which appears complete or not at all, and returns what is in it besides ztv.json.
/// Files of an earlier study there are replaced if `overwrite`; foreign ones are kept. Throws FileError, InputError (a
/// wireline of no viewpoint, a scale that is too large), Cancelled.
std::vector<ZoneFile> write_zone_study(const std::string& folder, const Store& store, const ZoneStudy& study,
                                       const ZoneStudyFileOptions& options, Progress& progress);

/// Checks that such a folder may be written at `path`. Throws FileError if nothing can be written beside it, or if it
/// is something else than a folder, or a folder with files in it that may not be replaced: without `overwrite` none,
/// with it only those of a folder that has a ztv.json.
void require_zone_folder(const std::string& path, bool overwrite);

}  // namespace itin::viewshed
