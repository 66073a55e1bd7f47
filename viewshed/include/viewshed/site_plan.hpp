// A choice of sites in one call: candidates and demand, the choice, links, routes to a hub, rasters, and their files.
//
//   viewshed::SitePlanRequest request{.search_area = Window::box({304000, 181000, 336000, 206000}), .count = 5};
//   const viewshed::SitePlan plan = viewshed::plan_sites(store, request, progress);
//   for (const viewshed::PlanFile& file : viewshed::write_site_plan("sites", plan, store, progress))
//     std::cout << file.path << ": " << file.what << '\n';
//
// Masts are chosen where they serve the most. With `turbines`, places are chosen where the demand sees least of them:
// what is served is then what sees a turbine. siting.hpp tells how the choice is made, and what is proved of it;
// site_coverage.hpp tells how sight lines are surveyed. Under NoData::kUnknown a mast serves what it certainly serves,
// and a turbine counts as seen wherever it may be.
//
// Positions are in the store's CRS, lengths in metres. InputError and warnings name fields between backticks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/window.hpp>
#include <profile/links.hpp>
#include <profile/sheet_choice.hpp>
#include <viewshed/demand.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/request.hpp>
#include <viewshed/result.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

namespace itin::viewshed {

/// A candidate, an existing site, or a point of the demand.
struct SitePlace {
  std::string name = {};
  Point2 position = {};
  std::optional<double> height = {};  ///< above what it stands on; nothing: a height of the request
  double cost = 0;                    ///< the cost of a candidate's place, without its mast; NaN: missing
  double weight = 1;                  ///< the weight of a point of the demand; NaN: missing
  std::string origin = {};            ///< where it stands in its source, for messages: "line 3"
  /// The antennas of a mast that has its own, for link budgets. What one has takes the place of what `link_budget` has
  /// of the first end's.
  std::vector<SiteSector> sectors = {};
};

/// Places, and what there is to say about the file or the person that they come from.
struct SitePlaces {
  std::string source = {};  ///< for messages; may be empty
  std::vector<SitePlace> places = {};
  std::vector<std::string> left_out = {};  ///< a line for each place that was not understood
  std::vector<std::string> warnings = {};
};

/// A mast that may be built.
struct Mast {
  double height = 20;
  double cost = 1;
};

/// The ellipse about every turbine that stays free of other turbines.
struct TurbineSpacing {
  double along = 0;   ///< half its axis along the wind, metres
  double across = 0;  ///< half its axis across
  double wind_from_deg = 0;

  /// Tells whether neither stands within the other's ellipse. A place on the ellipse is outside, up to rounding.
  bool keeps_apart(Point2 a, Point2 b) const;
};

/// The dwellings that turbines keep away from: points, or polygons.
struct SiteDwellings {
  std::string source = {};  ///< for messages
  std::vector<Point2> points = {};
  std::optional<Window> polygons = {};
  double setback = 0;  ///< no turbine stands nearer to a dwelling
  std::vector<std::string> warnings = {};
};

/// The quantity that is to be least: the demand that sees a tip, or a hub; or the visible height of all turbines,
/// summed over the demand.
enum class Minimised { kTips, kHubs, kHeight };

/// The turbines that are placed: all are of one size.
struct TurbinePlacement {
  double hub_height = 0, rotor_diameter = 0, tip_height = 0;
  Minimised minimised = Minimised::kTips;
  std::optional<TurbineSpacing> spacing = {};
  std::optional<SiteDwellings> dwellings = {};
  std::string farm = "proposed";  ///< the farm's name in turbines.csv

  /// Returns the height above the ground of the part that is looked for: the tip or the hub.
  double minimised_height() const { return minimised == Minimised::kHubs ? hub_height : tip_height; }
};

/// Where antennas may be mounted on buildings: before walls and on roofs (premises.hpp).
struct AntennaPlaces {
  double spacing = 1;                  ///< between places along a wall, and on a roof
  double reveal = 0.3;                 ///< how far before its wall an antenna is
  double storey = 3;                   ///< antennas on walls are at multiples of this height above the ground
  std::vector<double> poles = {0, 5};  ///< heights of antennas above the roof; with a frequency 0 is left out
};

/// What is to be served: points, the cells of a grid with weights, or premises; by default all cells with ground within
/// the radius of a candidate.
struct SiteDemand {
  /// The buildings and terraces of the themes within the radius of a site, 1 each: one is served where a site serves
  /// an antenna at one of its places.
  std::optional<AntennaPlaces> premises = {};
  std::optional<SitePlaces> points = {};
  std::optional<RasterGrid> grid = {};
  std::vector<double> weights = {};  ///< one for each cell of the grid; NaN counts as 0
  std::string source = {};           ///< names the grid in messages
  double height = 2;                 ///< metres above what targets stand on, for points without a height and for cells
  bool on_surface = false;           ///< targets stand on the themes

  bool is_cells_in_reach() const { return !points && !grid && !premises; }
};

struct SitePlanRequest {
  // The candidates: places, or those proposed in an area (site_proposal.hpp; turbines: the middles of squares).
  SitePlaces candidates = {};
  std::optional<Window> search_area = {};
  double spacing = 1000;  ///< about two candidates are proposed in each square of this side, or one turbine
  /// The masts for each candidate without a height of its own; the first is for existing sites without one, too. Not
  /// used with `turbines`.
  std::vector<Mast> masts = {Mast{}};
  bool on_surface = false;  ///< sites stand on the themes, where these are higher
  std::optional<TurbinePlacement> turbines = {};
  std::optional<Window> forbidden = {};  ///< where no site may stand
  SitePlaces existing = {};              ///< sites that serve already

  SiteDemand demand = {};
  double radius = 10000;  ///< how far a site serves, or is seen
  double cell_size = 50;  ///< the cells of the demand and of the rasters, unless the demand has a grid
  /// With a frequency, GHz, a target is served only if its link leaves `fresnel` of the first Fresnel zone's radius
  /// clear. Links among sites are judged so, too.
  std::optional<double> frequency_ghz = {};
  double fresnel = 0.6;
  /// With a link budget, which needs a frequency and a sensitivity, a target is served instead where its receiver gets
  /// the sensitivity and `margin_db` more, in sight or not. Not for `turbines` and premises; without multipath. Rain
  /// takes no part in the choice; it is told of each point.
  profile::BudgetQuery link_budget = {};
  double margin_db = 0;

  // The choice ends at the first of these that is reached; at least one is given.
  std::optional<std::size_t> count = {};
  std::optional<double> budget = {};  ///< the most that the sites may cost together
  std::optional<double> share = {};   ///< the part of the demand that is to be served, 0 to 1
  std::optional<double> min_spacing = {};
  int cover = 1;              ///< how many sites must serve a target, 1 to 255
  bool intervisible = false;  ///< chosen sites must reach each other over links between them and existing sites
  /// The place that all chosen sites must reach over such links; kHubHeight above the ground where it has no height.
  static constexpr double kHubHeight = 20;
  std::optional<SitePlace> hub = {};
  bool exact_chosen = true;  ///< false: bounds on what chosen sites serve may stay open, and there are no swaps
  bool swaps = true;

  Earth earth = {};
  ThemeChoice themes = ThemeChoice::none();  ///< what stands on the ground
  NoData nodata = NoData::kUnknown;

  // The following change the speed, never the result.
  Engine engine = Engine::kAuto;
  std::optional<double> tolerance = {};  ///< the first look's; nothing: chosen by the number of targets
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
  /// A function that is called with the survey before it begins, and with the number of options and existing sites in
  /// it: to restore what an earlier run had found, and to keep what this one finds.
  std::function<void(SiteCoverage& coverage, std::size_t sites)> on_survey = {};

  Objective objective() const { return turbines ? Objective::kLeast : Objective::kMost; }
  bool sums_heights() const { return turbines && turbines->minimised == Minimised::kHeight; }
  bool has_links() const { return intervisible || hub; }
  bool by_level() const { return link_budget.asks(); }
  /// The least level that serves. Precondition: by_level().
  double least_dbm() const { return *link_budget.sensitivity_dbm + margin_db; }
};

/// A place where a site may stand.
struct SiteCandidate {
  SitePlace place;
  std::string proposed_as;  ///< why it was proposed; empty for candidates that were given
};

/// Candidates that may not be chosen, all for one reason.
struct BarredCandidates {
  std::string why;                   ///< the reason, worded to follow "candidate 3 "
  std::size_t first = 0, count = 0;  ///< their range in SiteInputs::left_out
};

/// What is known of a point of the demand besides its place and height.
struct DemandPoint {
  std::string name = {};
  std::size_t number = 0;  ///< its place in SiteDemand::points, from 0
  double weight = 1;
};

/// The request as it was understood.
struct SiteInputs {
  std::vector<SiteCandidate> candidates;
  // An option is a candidate with a mast. Existing sites follow the options in `positions`.
  std::vector<SiteOption> options;
  std::vector<SitePosition> positions;
  SiteTargets targets;
  Demand demand;
  DemandSet cells;                        ///< if cells in reach are the demand: those with ground
  std::vector<DemandPoint> points;        ///< one for each of targets.points, where the demand is points
  Weight total = 0;                       ///< all demand
  std::vector<std::string> left_out;      ///< a line for each place that is not used, and why
  std::vector<BarredCandidates> barred;   ///< which of these are candidates where no site may stand
  std::size_t demand_without_ground = 0;  ///< points

  std::size_t existing() const { return positions.size() - options.size(); }
};

/// An option's coverage in the demand's own measure.
struct CoverageSummary {
  double certain = 0, possible = 0;
};

/// What the survey told of an option.
struct OptionSurvey {
  CoverageSummary first;  ///< after the first look
  CoverageSummary last;
  bool exact = false;
  int stage = 0;          ///< how often it was surveyed more closely; -1: never surveyed
  std::string looked_at;  ///< the stage in words
};

/// A stage of the survey.
struct SurveyStage {
  std::string name;                ///< "tolerance 4 m", "exact", ...
  std::size_t needed_no_more = 0;  ///< for how many options it was the last
};

struct LinkEnd {
  enum class Kind { kChosen, kExisting, kHub };
  Kind kind = Kind::kChosen;
  SitePosition place;
};

/// A line of sight between two ends of a network, by their numbers.
struct SiteLink {
  std::size_t from = 0, to = 0;
  profile::LinkResult line;

  const profile::LineFindings& found() const { return *line.found; }
};

struct SiteNetwork {
  std::vector<LinkEnd> ends;  ///< chosen sites in their order, existing ones, the hub
  /// Between all chosen sites; where links hold the choice together, between all ends. None among turbines.
  std::vector<SiteLink> links;

  const SitePosition& from(const SiteLink& link) const { return ends[link.from].place; }
  const SitePosition& to(const SiteLink& link) const { return ends[link.to].place; }
};

/// A hop from one end of a network to another over a link; all are given by their numbers.
struct RouteHop {
  std::size_t from = 0, to = 0, link = 0;
};

/// A chosen or an existing site's route to the hub, over links that meet the rules: the route of the fewest hops, and
/// among those the shortest.
struct SiteRoute {
  std::size_t site = 0;        ///< an end of the network
  std::vector<RouteHop> hops;  ///< empty: the site does not reach the hub
};

/// Rasters of the chosen sites, numbered first, and the existing ones behind them. Outside is what has no ground or is
/// beyond reach: of all candidates and existing sites, or, where demand is points, of the chosen and existing ones.
struct SiteRasters {
  RasterGrid grid;
  std::vector<std::uint16_t> redundancy;  ///< how many serve a cell; kOutside beyond reach or data
  /// Which of `servers` serves a cell best, from 1; 0: none. It is the nearest that serves it or, with a link budget,
  /// the one that gives it the greatest level; the nearest again where ground without data leaves a level open.
  std::vector<std::uint16_t> best_server;
  std::vector<Verdict> served;       ///< kVisible: by enough sites
  std::vector<std::string> servers;  ///< the names of the sites; of a site with sectors, those of its sectors
  static constexpr std::uint16_t kOutside = 65535;

  std::uint64_t count(Verdict verdict) const {
    return static_cast<std::uint64_t>(std::count(served.begin(), served.end(), verdict));
  }
};

/// How masts serve a point of the demand.
enum class PointService : std::uint8_t {
  kServed,
  kTooFew,     ///< fewer sites serve it than SitePlanRequest::cover asks for
  kUndecided,  ///< it is served if ground without data hides nothing, or was not surveyed exactly (`exact_chosen`)
  kZoneCut,    ///< it is in sight, with too little of the Fresnel zone clear
  kTooWeak,    ///< the greatest level that a site gives it is too low
  kHidden,
  kOutOfReach,  ///< it lies beyond the radius of all sites
  kNoGround     ///< there is no data under it
};

/// A line between a site and a point of the demand, as `itin los` judges it.
struct ServingLine {
  std::size_t site = 0;  ///< an end of the network
  double distance_m = 0;
  /// Where the line is cut deepest or, if it is free, clears the least part of the Fresnel zone: never a mast's foot.
  std::optional<double> tightest_clearance_m = {};
  std::optional<double> tightest_m = {};        ///< the distance of that place from the site
  std::optional<double> fresnel_fraction = {};  ///< nothing without a frequency
  // With a link budget; nothing where an antenna is within a feature:
  std::optional<double> level_dbm = {};
  std::optional<double> margin_db = {};  ///< over the sensitivity
  std::string sector = {};               ///< the site's antenna that it is, where the site has several
  // With rain besides, as profile::LinkBudget has them:
  std::optional<double> rain_exceeded_db = {};  ///< for 0.01 % of an average year
  std::optional<profile::Availability> availability = {};
};

/// What the chosen and the existing masts are to a point of the demand.
struct PointResult {
  DemandPoint point = {};
  SitePosition place = {};  ///< its ground is 0 where there is none
  PointService service = PointService::kOutOfReach;
  std::size_t serving = 0;  ///< how many sites serve it
  /// The line to the nearest site that serves it, or with a link budget to the one that gives it most; else to the one
  /// within reach that comes nearest to serving it.
  std::optional<ServingLine> line = {};
};

struct PremisesSurvey;

struct SitePlan {
  SitePlanRequest request;  ///< without the points or weights of the demand, which are in `inputs`
  std::string crs_wkt;
  SiteInputs inputs;
  Choice choice;
  /// Heights that are seen of each option, where their sum is what is least; they measure value and gains instead of
  /// the demand.
  std::optional<Demand> heights;
  std::vector<OptionSurvey> surveys;  ///< one for each option
  std::vector<SurveyStage> stages;    ///< coarse to exact
  bool leaves_open = false;           ///< whether ground without data may leave open what sites serve
  SiteNetwork network;
  std::vector<SiteRoute> routes;  ///< from the network's sites to the hub; empty without a hub
  std::vector<double> ground_m;   ///< elevation of the ground under each chosen site, which may stand on a roof
  /// By how much the value of masts would grow if ground without data hid nothing; the part of the value of turbines
  /// that is seen only then.
  double undecided = 0;
  ClassShares shares;  ///< what the chosen and the existing sites serve of the demand, or leave undecided
  SiteRasters rasters;
  /// With a link budget, the levels that the chosen and the existing sites give to the cells of the rasters, as
  /// compute() has them in mode kLevel; its observers are the rasters' servers. Else null.
  std::shared_ptr<const Result> levels;
  std::vector<PointResult> points;  ///< where masts serve points, each of these, in the order in which they were given
  /// Where premises are the demand, what those of the chosen and the existing sites that serve any are to each building
  /// (premises.hpp); else null.
  std::shared_ptr<const PremisesSurvey> premises;
  std::vector<std::string> warnings;  ///< a line each; "`left_out`" stands for SiteInputs::left_out
  Statistics statistics;

  const SitePosition& place_of(const ChosenSite& site) const { return inputs.positions[site.option]; }
  const SiteCandidate& candidate(std::size_t option) const { return inputs.candidates[inputs.options[option].place]; }
  double in_metric(Weight weight) const { return (heights ? *heights : inputs.demand).in_metric(weight); }
  /// Return what the chosen and the existing sites serve together: in the demand's own measure, and as a share of all
  /// demand.
  double served() const;
  double served_percent() const;
  double undecided_percent() const;
  /// Returns how many options were surveyed more closely after the first look.
  std::size_t refined() const;
  /// Tells whether every option was surveyed exactly from the first, and none by bounds.
  bool all_exact() const { return request.sums_heights() || stages.size() == 1; }
  /// Tells whether no choice within the goal is better.
  bool is_best() const { return choice.lower_bound == choice.upper_bound; }
  bool is_chosen(std::size_t option) const;
  /// Returns in words why an option is not part of the choice.
  std::string reason(std::size_t option) const;
  /// Returns in words when a target is served, or what is to be least.
  std::string meaning() const;
};

/// Chooses sites. Throws InputError where the request makes no sense, holds no candidate that may be chosen, or takes
/// more memory than it allows; Error where the choice cannot be made (check_goal()), or no site serves any premises;
/// Cancelled, CorruptStore, FileError.
SitePlan plan_sites(const Store& store, SitePlanRequest request, Progress& progress);

/// A file of a plan.
struct PlanFile {
  std::string path;
  std::string what;  ///< what is in it
};

/// Returns the files that write_site_plan() writes into the folder.
std::vector<PlanFile> site_plan_files(const std::string& folder, const SitePlanRequest& request);

struct SitePlanFileOptions {
  std::vector<std::pair<std::string, std::string>> metadata = {};  ///< added to rasters
  bool overwrite = false;
  profile::SheetChoice sheets = {};  ///< premises.png has its project and its date
};

/// Writes tables (CSV), layers (GeoPackage), rasters (GeoTIFF) and maps (PNG) into a folder, which is made where it is
/// not there, and returns the files. The store is the one of the plan. Throws FileError, Cancelled.
std::vector<PlanFile> write_site_plan(const std::string& folder, const SitePlan& plan, const Store& store,
                                      Progress& progress, const SitePlanFileOptions& options = {});

/// Returns the JSON document of the plan: the members that `itin site --json` prints about the choice. `metadata` is
/// that of the store.
std::string json_of(const SitePlan& plan, const StoreMetadata& metadata);

}  // namespace itin::viewshed
