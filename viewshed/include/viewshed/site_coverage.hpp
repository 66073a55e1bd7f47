// Bounds what each of many sites serves, tighter and tighter: first all of them over one coarse envelope of the
// surface, then, for those that are asked about again, exactly. Cells are swept over the full surface, which takes no
// longer than a coarse look, so that they are exact at once where the memory holds it.
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
// Exact means every triangle of the full surface in double precision, as compute(). Themes that stand on the ground
// count from the first stage on: where the memory holds the surface with them, it is exact at once; else bounds come
// from how low and how high that surface is within squares. With a `tolerance` the bare terrain of that level comes
// first: features only raise it, so that what it hides for a target on the ground needs no further stage. (Where flat
// foundations cut into it, the surface with its features comes first all the same.)
//
// Under NoData::kUnknown the bounds are of what is certainly served: by no line across ground without data.
//
// With a FresnelCriterion the zone is judged over the same surfaces, after the line (over coarse ones only where the
// memory does not hold the full one): what the lower one cuts is not served, what clears the upper one is. In the end
// it is what fresnel_clearance() says of each link's profile.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/siting.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// A site on its ground.
struct SitePosition {
  std::string name;
  Point2 position;
  double height = 0;  ///< metres above the ground
  double ground = 0;  ///< metres; the surface's elevation there, with features if it stands on these

  double elevation() const { return ground + height; }
};

/// The elevation under each position on the full surface with the themes; nothing where there is no data.
std::vector<std::optional<double>> ground_under(const Store& store, const std::vector<Point2>& positions,
                                                const ThemeChoice& themes, Progress& progress);

/// One of the two: the centres of a raster's cells, or points. Element numbers: see element_of() and SiteCoverage.
struct SiteTargets {
  std::optional<RasterGrid> grid;
  std::vector<Point2> points;
  double height = 0;        ///< metres above the ground
  bool on_surface = false;  ///< above the surface with the themes instead
};

struct SiteSurvey {
  std::vector<SitePosition> positions;  ///< one per option
  SiteTargets targets;
  double radius = 10000;  ///< metres: no site serves farther
  Earth earth;
  /// Served is what is certainly seen: under kUnknown nothing across ground without data, as under kBlock.
  NoData nodata = NoData::kUnknown;
  ThemeChoice themes = ThemeChoice::none();
  /// Served are targets in sight; with a criterion only those whose link meets it, too.
  std::optional<FresnelCriterion> fresnel;
  // Change the speed, never what is exact.
  Engine engine = Engine::kAuto;    ///< judges cells at full detail; points are decided by rays
  std::optional<double> tolerance;  ///< the first stage's; none: chosen by the number of points
  /// For surfaces, and for what is known of what each site serves.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
};

/// Over what lies within the radius of a site, and the data; cell edges lie on multiples of the cell size. Throws
/// InputError if there is no such ground.
RasterGrid grid_of_reach(const Store& store, const std::vector<SitePosition>& positions, double radius,
                         double cell_size);

/// A grid's cells as elements of a demand: `count` elements, of which the padding about the grid is never served.
std::size_t element_count(const RasterGrid& grid);
std::size_t element_of(const RasterGrid& grid, RasterGrid::Cell cell);
RasterGrid::Cell cell_of(const RasterGrid& grid, std::size_t element);

/// Those of the targets that have ground under them.
DemandSet with_ground(const Store& store, const SiteTargets& targets, Progress& progress);

/// Everything within the radius of a site, with or without ground.
DemandSet within_reach(const SiteTargets& targets, Point2 position, double radius);

/// The bounds on what each site serves take no more bytes than this; see SiteSurvey::memory_bytes.
std::uint64_t bytes_of_coverage(const SiteSurvey& survey);

class SiteCoverage final : public Coverage {
 public:
  /// The store and the progress must outlive it. Before explore() all that is known is the radius. Throws
  /// InputError, also where three quarters of memory_bytes do not hold what each site may serve.
  SiteCoverage(const Store& store, SiteSurvey survey, Progress& progress);
  SiteCoverage(const Store&& store, SiteSurvey survey, Progress& progress) = delete;
  ~SiteCoverage() override;

  const CoverageBounds& bounds(std::size_t option) const override;
  /// Throws as compute_certified() does.
  void refine(std::span<const std::size_t> options) override;
  /// At every option that was not looked at yet.
  void explore();
  /// Frees the memory of the surfaces. They are read again where options are refined after this.
  void release_surfaces();

  /// How often an option was refined after the first stage, and how often that can be at most.
  int stage(std::size_t option) const;
  int last_stage() const;
  /// The bounds of an option after the first pass.
  const CoverageBounds& first_bounds(std::size_t option) const;
  /// In words: "tolerance 4 m", "exact", ...
  std::string stage_name(int stage) const;
  /// Puts back what an earlier run had found. Precondition: it is of the same survey.
  void restore(std::size_t option, int stage, const CoverageBounds& bounds);
  /// Is told of every option looked at again, after each stage.
  std::function<void(std::size_t option, int stage, const CoverageBounds& bounds)> on_refined;

  const Statistics& statistics() const;
  /// Whether ground without data may leave open what the sites serve: the rule is kUnknown, and a sight line may cross
  /// it. What they serve if it hides nothing, a survey under kClear tells.
  bool leaves_open() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::viewshed
