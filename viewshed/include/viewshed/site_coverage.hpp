// Bounds what each of many sites serves, tighter and tighter: first for all sites over one coarse envelope of the
// surface, then exactly for the sites that are refined. Cells are swept over the full surface where the memory holds
// it: that takes no longer than a coarse survey, and is exact at once.
//
//   viewshed::SiteSurvey survey;
//   const Point2 hill{310375, 183525};
//   if (const auto ground = viewshed::ground_under(store, {hill}, ThemeChoice::none(), progress)[0])
//     survey.positions = {{"Garth Hill", hill, 20, *ground}};
//   survey.targets.grid = viewshed::grid_of_reach(store, survey.positions, survey.radius, 100);
//   viewshed::SiteCoverage coverage(store, survey, progress);
//   coverage.explore();
//   const std::size_t cells = coverage.bounds(0).certain.size();  // certainly served by the first
//
// Exact means that every triangle of the full surface counts, in double precision, as in compute(). Themes that stand
// on the ground count from the first stage on. Where the memory holds the surface with the themes, the first stage is
// exact; else bounds come from how low and how high that surface is within squares. With a `tolerance` the bare terrain
// of that level comes first: features only raise it, so that a target on the ground that the terrain hides needs no
// further stage. (Where flat foundations cut into the terrain, the surface with its features comes first all the same.)
//
// Under NoData::kUnknown the bounds are of what is certainly served, that is, by no line across ground without data.
// Sites that are to be hidden need the worst case: with OpenTargets::kServed what such ground leaves open counts, too.
//
// With a FresnelCriterion the Fresnel zone is judged over the same surfaces, after the line (over coarse surfaces only
// where the memory does not hold the full one). A target whose zone the lower surface cuts is not served; a target
// whose zone clears the upper surface is. The last stage agrees with fresnel_clearance() on each link's profile.
//
// With a ServingLevel a target is served where a link budget gives its receiver enough. That takes all of the profile
// under each line, and is exact at once; no option can be left out by bounds, except by its radius.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <profile/diffraction.hpp>
#include <viewshed/result.hpp>
#include <viewshed/siting.hpp>

namespace itin::viewshed {

/// A site on its ground.
/// An antenna of a site that has several, each of which looks its own way.
struct SiteSector {
  std::string name = {};
  profile::AimedAntenna antenna = {};
};

struct SitePosition {
  std::string name = {};
  Point2 position = {};
  double height = 0;  ///< metres above the ground
  double ground = 0;  ///< metres; the surface's elevation there, with features if it stands on these
  /// With a link budget: the antennas in place of the budget's, each with its pattern and where it points; empty: the
  /// one of the budget.
  std::vector<SiteSector> sectors = {};

  double elevation() const { return ground + height; }
};

/// Returns the elevation under each position on the full surface with the themes; nothing where there is no data.
std::vector<std::optional<double>> ground_under(const Store& store, const std::vector<Point2>& positions,
                                                const ThemeChoice& themes, Progress& progress);

/// The targets: either the centres of a raster's cells, or points. For the numbers of elements see element_of() and
/// SiteCoverage.
struct SiteTargets {
  std::optional<RasterGrid> grid = {};
  std::vector<Point2> points = {};
  double height = 0;                 ///< metres above the ground
  std::vector<double> heights = {};  ///< one for each point; empty where all have `height`
  bool on_surface = false;           ///< heights are above the surface with the themes instead
  /// The element of the demand that each point is a place of, ascending from 0: an element is served where one of its
  /// points is. Empty: each point is an element.
  std::vector<std::uint32_t> elements = {};

  double height_of(std::size_t point) const { return heights.empty() ? height : heights[point]; }
};

/// What the targets count as that only ground without data could hide, under NoData::kUnknown.
enum class OpenTargets {
  kUnserved,  ///< the bounds are of what is certainly served
  kServed     ///< the bounds are of what may be served: the worst case for sites that are to be hidden
};

/// By what level at its receiver a target is served, in sight or not. The first end of each link is a site.
struct ServingLevel {
  RadioPath radio = {};  ///< its effective radius is that of the survey's Earth
  profile::BudgetQuery budget = {};
  double least_dbm = 0;           ///< a target is served from this level on
  bool sites_on_surface = false;  ///< heights of sites are above the surface with the themes
};

struct SiteSurvey {
  std::vector<SitePosition> positions = {};  ///< one per option
  SiteTargets targets = {};
  double radius = 10000;  ///< metres: no site serves farther
  Earth earth = {};
  /// Under kBlock no target across ground without data is served; under kUnknown `open` decides.
  NoData nodata = NoData::kUnknown;
  OpenTargets open = OpenTargets::kUnserved;
  ThemeChoice themes = ThemeChoice::none();
  /// With a criterion, a target in sight is served only if its link meets the criterion, too.
  std::optional<FresnelCriterion> fresnel = {};
  /// In place of sight and of Fresnel zones: levels, which have one stage. They are those of compute() in mode kLevel
  /// for cells, and of survey_links() for points.
  std::optional<ServingLevel> level = {};
  // The following change the speed, never what is exact.
  Engine engine = Engine::kAuto;         ///< judges cells at full detail; points are decided by rays
  std::optional<double> tolerance = {};  ///< tolerance of the first stage; nothing: chosen by the number of points
  /// The memory for surfaces and for the bounds on what each site serves.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
};

/// Returns a grid over what lies within the radius of a site and within the data; cell edges lie on multiples of the
/// cell size. Throws InputError if there is no such ground.
RasterGrid grid_of_reach(const Store& store, const std::vector<SitePosition>& positions, double radius,
                         double cell_size);

/// A grid's cells as elements of a demand: element_count() is their number, with padding about the grid that is never
/// served; element_of() and cell_of() convert between them.
std::size_t element_count(const RasterGrid& grid);
std::size_t element_of(const RasterGrid& grid, RasterGrid::Cell cell);
RasterGrid::Cell cell_of(const RasterGrid& grid, std::size_t element);

/// Returns those of the targets that have ground under them.
DemandSet with_ground(const Store& store, const SiteTargets& targets, Progress& progress);

/// Returns the number of elements of a demand of these targets.
std::size_t element_count(const SiteTargets& targets);

/// Returns all cells or points within the radius of a site, with or without ground.
DemandSet within_reach(const SiteTargets& targets, Point2 position, double radius);
/// Returns all cells or points within the radius of any of the sites.
DemandSet within_reach(const SiteTargets& targets, std::span<const SitePosition> sites, double radius);

/// Returns the most bytes that the bounds on what each site serves take; see SiteSurvey::memory_bytes.
std::uint64_t bytes_of_coverage(const SiteSurvey& survey);

class SiteCoverage final : public Coverage {
 public:
  /// Prepares the survey; the store and the progress must outlive it. Before explore() the bounds know only the radius.
  /// Throws InputError, also where three quarters of memory_bytes do not hold what each site may serve.
  SiteCoverage(const Store& store, SiteSurvey survey, Progress& progress);
  SiteCoverage(const Store&& store, SiteSurvey survey, Progress& progress) = delete;
  ~SiteCoverage() override;

  /// Bounds on the elements that an option serves.
  const CoverageBounds& bounds(std::size_t option) const override;
  /// Takes each of the options one stage further. Throws as compute_certified() does.
  void refine(std::span<const std::size_t> options) override;
  /// Judges, at the first stage, every option that was not judged yet.
  void explore();
  /// Does so for some options alone. Their bounds are those that explore() finds among all.
  void explore(std::span<const std::size_t> options);
  /// Frees the memory of the surfaces. Refining options after this reads the surfaces again.
  void release_surfaces();

  /// Return how often an option was refined after the first stage, and how often it can be at most.
  int stage(std::size_t option) const;
  int last_stage() const;
  /// Returns the bounds of an option after the first stage.
  const CoverageBounds& first_bounds(std::size_t option) const;
  /// Returns these on cells or points, as on_refined is told them.
  const CoverageBounds& first_bounds_of_targets(std::size_t option) const;
  /// Returns the stage in words: "tolerance 4 m", "exact", ...
  std::string stage_name(int stage) const;
  /// Restores the stage and bounds that an earlier run had told on_refined. Precondition: that run was of the same
  /// survey.
  void restore(std::size_t option, int stage, const CoverageBounds& bounds);
  /// A function that is called for every option judged, after each stage. Its bounds are on cells or points.
  std::function<void(std::size_t option, int stage, const CoverageBounds& bounds)> on_refined;

  const Statistics& statistics() const;
  /// Tells whether ground without data may leave open what the sites serve: the rule is kUnknown, and a sight line may
  /// cross such ground. Surveys under kBlock and kClear tell what the sites serve if that ground hides all, or nothing.
  bool leaves_open() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
