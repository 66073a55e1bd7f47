// Which cells of a raster observers see: those whose centres they have a sight line to.
//
//   viewshed::Request request;
//   request.observers = {{"mast", {318000, 176000}, 20}};
//   request.target_height = 2;
//   request.radius = 10000;
//   request.detail = Detail::tolerance(2);
//   const viewshed::Result result = viewshed::compute(store, request, progress);
//   viewshed::write_geotiff("out.tif", result, {.crs_wkt = store.metadata().crs_wkt});
//   const viewshed::Result certain = viewshed::compute_certified(store, request, {}, progress).result;
//
// Both ends of a sight line stand on the ground of the surface queried, without the raised features of the chosen
// themes, unless the request puts them on top of these. A cell is decided by its centre (cx, cy): the target is at
// T(cx, cy) + target_height, so one on the ground within a building is hidden. A sight line that grazes the surface
// sees (law 4).
//
// Accuracy: the result is exact for the surface asked for. Each cell has the verdict of its sight line over every
// triangle, decided in double precision. Ground that rises less than a micrometre above a sight line grazes it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// A range of angles, degrees. Azimuths are clockwise from grid north and may pass through it (350 to 10). Elevations
/// are those of the straight line after curvature and refraction, -90 to 90, upwards positive.
struct AngleRange {
  double from = 0;
  double to = 0;
};

struct Observer {
  std::string name;  ///< for messages and maps; may be empty
  Point2 position;
  double height = 2;  ///< metres above the surface, or an elevation when `absolute`
  bool absolute = false;
  // The observer's own field of view and targets, where they differ from the request's.
  std::optional<double> target_height = std::nullopt;
  std::optional<double> radius = std::nullopt;
  std::optional<double> min_radius = std::nullopt;
  std::optional<AngleRange> azimuth = std::nullopt;
  std::optional<AngleRange> elevation = std::nullopt;
};

/// Under kUnknown a line is undecided if only ground without data could hide it. Modes that count or name observers
/// take the observers that certainly see. A value that such ground leaves open is not given.
using itin::NoData;

/// The algorithm that decides sight lines to cells. The result never depends on it.
enum class Engine {
  kAuto,   ///< whichever takes less time, as benchmarks/README.md measured it
  kSweep,  ///< a sweep of the surface about each observer
  kRays    ///< Embree's rays; not in mode kHeight, which asks more than a ray tells
};

/// The value that a cell gets from the observers that see it.
enum class Mode {
  kVisible,      ///< whether any does
  kCount,        ///< how many do
  kWhich,        ///< which do
  kAngle,        ///< the greatest elevation angle of their sight lines
  kNearest,      ///< the nearest of them, and its distance
  kBlocker,      ///< where none does, what hides the cell from the nearest observer that looks there
  kHeight,       ///< the least height above what targets stand on at which one is seen by any of them
  kProbability,  ///< how probably any of them does where heights are uncertain: the greatest of theirs
  kFresnel,      ///< whether any does with its first Fresnel zone clear
  kLoss          ///< what a radio path loses by diffraction: of the observer with the least loss in all
};

/// Says whether a line of sight is clear, or the zone about it, as far as that is known. Rasters hold these numbers.
enum class Verdict : std::uint8_t {
  kHidden = 0,
  kVisible = 1,
  kUndecided = 2,  ///< at the detail asked for, or for want of ground
  kZoneCut = 3,    ///< in sight, but something rises into the Fresnel zone; kFresnel alone
  kOutside = 255   ///< outside every field of view, or no ground to look at
};

/// The errors of the surface's vertices are normal, with this standard deviation. The errors of vertices x apart are
/// correlated as exp(-x / correlation_length), or not at all where that length is 0. Between vertices errors are
/// linear, and what stands on the surface moves with it.
struct VerticalError {
  double sigma = 0;               ///< metres, positive
  double correlation_length = 0;  ///< metres
};

/// A link is clear if at least this fraction of the first Fresnel zone's radius is free of ground, everywhere.
struct FresnelCriterion {
  double wavelength = 0;  ///< metres
  double fraction = 0.6;  ///< positive, at most 1
};

struct Request {
  std::vector<Observer> observers;
  double target_height = 0;  ///< metres above the surface, or an elevation when `target_absolute`
  bool target_absolute = false;
  // The field of view of observers that have none of their own.
  std::optional<double> radius;  ///< metres; none: the whole coverage
  double min_radius = 0;
  std::optional<AngleRange> azimuth;
  std::optional<AngleRange> elevation;
  // The cells: one of the two, or neither. Then the cell size is the least of 1, 2, 5, 10, ... (or their decimal
  // fractions) metres that gives at most kDefaultCells cells per side.
  std::optional<double> cell_size;
  std::optional<RasterGrid> grid;
  Earth earth;
  Detail detail = Detail::tolerance(0);      ///< the surface's level of detail; not used with a Tin
  ThemeChoice themes = ThemeChoice::none();  ///< raised features on the surface; not used with a Tin
  // Both ends stand on the ground without raised features, or on the surface with them. compute() takes the surface for
  // both where it is given no ground.
  bool observers_on_surface = false;
  bool targets_on_surface = false;
  NoData nodata = NoData::kUnknown;
  Engine engine = Engine::kAuto;
  Mode mode = Mode::kVisible;
  VerticalError vertical_error;  ///< kProbability
  FresnelCriterion fresnel;      ///< kFresnel: a visible cell is one whose zone is clear
  RadioPath radio;               ///< kLoss; its effective radius is that of `earth`
};

inline constexpr int kDefaultCells = 2048;

inline constexpr std::uint16_t kCountOutside = 65535;

inline constexpr std::uint32_t kNoBlocker = 0xffffffff;
/// The blocker where ground without data comes first: it hides under NoData::kBlock, and may hide under
/// NoData::kUnknown.
inline constexpr std::uint32_t kMissingGround = 0xfffffffe;
/// A triangle of the surface that hides something.
struct BlockingTriangle {
  std::array<GridPoint, 3> corners;
  std::uint16_t theme = 0;  ///< from 1; 0: terrain
  friend auto operator<=>(const BlockingTriangle&, const BlockingTriangle&) = default;
};

struct CellCounts {
  std::uint64_t visible = 0;  ///< to at least one observer
  std::uint64_t hidden = 0;
  std::uint64_t undecided = 0;
  std::uint64_t outside = 0;
  std::uint64_t zone_cut = 0;  ///< in sight of at least one, with no clear zone; kFresnel

  CellCounts& operator+=(const CellCounts& c) {
    visible += c.visible, hidden += c.hidden, undecided += c.undecided, outside += c.outside, zone_cut += c.zone_cut;
    return *this;
  }
  std::uint64_t in_view() const { return visible + hidden + undecided + zone_cut; }
};

struct Statistics {
  RetrievalStatistics retrieval;
  std::uint64_t triangles = 0;
  std::uint64_t lines = 0;  ///< sight lines decided
  double retrieval_seconds = 0;
  double scene_seconds = 0;
  double lines_seconds = 0;

  /// Adds the retrieval of another surface, which has `of_triangles` triangles or posts.
  void add_retrieval(const RetrievalStatistics& read, std::uint64_t of_triangles, double seconds) {
    retrieval += read;
    triangles += of_triangles;
    retrieval_seconds += seconds;
  }
  Statistics& operator+=(const Statistics& s) {
    add_retrieval(s.retrieval, s.triangles, s.retrieval_seconds);
    lines += s.lines;
    scene_seconds += s.scene_seconds;
    lines_seconds += s.lines_seconds;
    return *this;
  }
};

// What modes tell of each cell besides whether it is seen, row by row.

/// kCount: how many observers certainly see the cell, or kCountOutside.
struct Counts {
  std::vector<std::uint16_t> count;
};
/// kWhich: the set of observers that do, see raster_bit().
struct ObserverSets {
  std::vector<std::uint32_t> words;
};
/// kAngle: the greatest elevation angle of the lines after curvature and refraction; NaN where no observer sees the
/// cell.
struct Angles {
  std::vector<float> angle_deg;
};
/// kNearest: the observer's number from 1 in their order, 0 where none sees; and how far away it is horizontally, or
/// NaN.
struct NearestObservers {
  std::vector<std::uint32_t> number;
  std::vector<float> distance_m;
};
/// kBlocker.
struct Blockers {
  std::vector<BlockingTriangle> triangles;  ///< those that first hide a cell, ascending
  /// What hides each hidden cell: which of these triangles rises above the sight line first, kMissingGround, or
  /// kNoBlocker; and its theme (from 1; 0: terrain), or the same value.
  std::vector<std::uint32_t> triangle;
  std::vector<std::uint32_t> theme;
  /// Which feature of that theme the triangle is part of, by features_at(), if the surface is a store's; kNoBlocker
  /// where it is part of none.
  std::vector<std::uint32_t> feature;
};
/// kHeight: 0 where the ground is seen. NaN where there is no height (outside, beyond the elevations in view, or behind
/// missing ground that blocks). NaN also where none is known: where the line crosses ground without data under
/// NoData::kUnknown, unless another observer certainly sees as low. Exact: the sight line to that height touches the
/// surface within a micrometre.
struct LeastHeights {
  std::vector<float> height_m;
};
/// kProbability: the probability that the whole line is clear, with a standard error of at most 0.022, alike in
/// neighbouring cells. 0 for a target at an elevation below the ground, or behind ground without data that blocks. NaN
/// outside, and where ground without data leaves it open under NoData::kUnknown.
struct Probabilities {
  std::vector<float> probability;
};
/// kLoss: delta-Bullington diffraction by ITU-R P.526 (profile/diffraction.hpp), and the loss in free space along the
/// slant line, of the observer for whom their sum is least. NaN outside; at an observer's own place; where a raised
/// feature holds an end; and where a line crosses ground without data, unless NoData::kClear lets it pass or
/// NoData::kBlock leaves that observer out.
struct Losses {
  std::vector<float> diffraction_db;
  std::vector<float> free_space_db;
};
/// The values of a mode; kVisible and kFresnel have none.
using ModeValues = std::variant<std::monostate, Counts, ObserverSets, Angles, NearestObservers, Blockers, LeastHeights,
                                Probabilities, Losses>;

struct Result {
  Request request;  ///< as understood
  RasterGrid grid;
  /// The verdicts, in every mode. A cell is undecided where only ground without data leaves it open, under
  /// NoData::kUnknown, and in certified results where the level leaves it open.
  std::vector<Verdict> visible;
  bool certified = false;                ///< made by compute_certified(): verdicts at a level are certain
  bool decided_exactly = false;          ///< a certified one over the full surface, where the level is no cheaper
  ModeValues values;                     ///< what request.mode tells besides
  std::vector<std::string> theme_names;  ///< from a store: of theme 1 and so on
  CellCounts cells;                      ///< areas are these times grid.cell_area()
  std::vector<double> ground_m;          ///< elevation of the ground, or of what stands on it, under each observer
  bool crosses_voids = false;            ///< some sight line may have passed over ground without data
  std::vector<std::string> warnings;     ///< one line each
  Statistics statistics;

  /// Tells whether ground without data may leave cells or their values open.
  bool leaves_open() const { return crosses_voids && request.nodata == NoData::kUnknown; }
  /// The values of the mode, such as get<Counts>(). Throws std::bad_variant_access where they are another mode's.
  template <class Values>
  const Values& get() const {
    return std::get<Values>(values);
  }
  template <class Values>
  Values& get() {
    return std::get<Values>(values);
  }
};

/// The place of the bit that tells whether thing `number` (from 0) is in the set of a cell. A raster of sets consists
/// of grids of 32-bit words, one for every 32 things, one grid after the other.
struct RasterBit {
  std::size_t grid = 0;
  std::uint32_t mask = 0;
};
constexpr RasterBit raster_bit(std::size_t number) {
  return {number / 32, std::uint32_t{1} << (number % 32)};
}
/// How many grids a raster of sets of `count` things has.
constexpr std::size_t bit_grids(std::size_t count) {
  return (count + 31) / 32;
}

/// Computes a viewshed on a given surface. The Tin must hold every triangle that sight lines cross; where it ends there
/// is no data. Cost: O(n) for n triangles (about 0.1 microseconds each) and about 50 ns per cell and observer, 150 ns
/// in mode kHeight; in mode kLoss each cell takes all triangles under its line, about 60 ns each. Memory: 9 bytes per
/// post of a raster, 50 per triangle of others, and a tenth of a megabyte per thread. The result does not depend on the
/// number of threads. Throws InputError (an observer outside the data, by name; an unusable radius, cell size or angle;
/// more than 65534 observers to count), Cancelled.
Result compute(const Tin& tin, const Request& request, Progress& progress);

/// Computes as above, but ends that are not on the surface stand on `ground`, which must cover what the surface covers.
Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress);

struct ComputeOptions {
  // These change the speed, never the answer.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
  bool lattices = true;  ///< a raster is swept over its posts alone
  /// Whether ViewshedWithSurface::surface is wanted as a whole, where the memory holds it, for maps and horizons. If
  /// not, no more of a large surface is read than may be seen.
  bool whole_surface = true;
};

/// The surface over which sight lines were decided. Opaque: draw_map() and compute_on_surface() take it.
struct Surface;

/// A result and the surface that it was computed on, for maps and single observers while the store is open.
struct ViewshedWithSurface {
  std::shared_ptr<Surface> surface;  ///< a coarse one where that of the request was not read as a whole
  std::optional<Tin> ground;         ///< what ends stand on, where that is not the surface
  bool whole = true;                 ///< `surface` is that of the request
  Result result;
};

/// Computes a viewshed on the surface of a store at `request.detail`. Reads as much of the surface at once as the
/// memory holds: all of it; or, of a large raster, the heights that an observer may see, sector by sector about each
/// observer; or, of another surface, what decides, segment by segment. In segments a certified pass at a coarse level
/// decides most cells of the full surface, and the others take only the places where their lines come near the ground.
/// At a tolerance the pass tells which ground is hidden, and only the rest is read; the same holds for one observer on
/// a large surface that is not wanted as a whole. With rings, with themes that stand on the ground at a tolerance, and
/// in modes that ask more than whether a cell is seen, all ground under the lines is read. The answer is the same to
/// the last bit, in every mode. Cost, on one core: about a microsecond per point; for rasters a fifth of that, and 9
/// bytes per post. Throws what compute() on a Tin and triangulate() throw, and InputError where the line to a single
/// cell does not fit into the memory, or large rasters leave less than a quarter of it.
ViewshedWithSurface compute_with_surface(const Store& store, const Request& request, const ComputeOptions& options,
                                         Progress& progress);

/// Computes what is certain of the full surface, without reading all of it: no cell called certain differs from the
/// full surface's exact answer, at request.detail, in request.mode kVisible. Both ends of a sight line stand on the
/// full surface, whatever the tolerance. The certificates of the store's index cells (law 2) tell how low and how high
/// the full surface is about the level asked for. A block of cells is hidden if it rises nowhere above the ground
/// before it. What lies near an observer is decided exactly. All else is undecided: mostly what is in sight, and what
/// is nearly so. Features of Request::themes count as in compute_with_surface(), but hide nothing except near the
/// observer; targets may stand on them. With several observers a cell is certainly visible when it is so to one of
/// them, and certainly hidden when it is so to all. Under NoData::kUnknown a line across a void and back is never
/// certainly visible. Cost: about 2 microseconds per point of the level and 10 nanoseconds per cell and observer, and
/// 0.1 seconds for the bounds. Where exact answers cost no more, every cell is decided as by compute_with_surface() at
/// tolerance 0, except for such lines across voids. Levels of more than a million and a half points are looked at
/// sector by sector about each observer. Throws what compute_with_surface() throws.
ViewshedWithSurface compute_certified(const Store& store, const Request& request, const ComputeOptions& options,
                                      Progress& progress);

/// Returns the result of compute_with_surface() with default options, without the surface.
Result compute(const Store& store, const Request& request, Progress& progress);

/// Returns the request of a result for one of its observers alone, on the cells of all.
Request request_for_observer(const Result& result, std::size_t observer);

/// Computes the request of one observer alone on a surface that was retrieved for all from `store`.
Result compute_on_surface(const Store& store, const ViewshedWithSurface& computed, const Request& request,
                          Progress& progress);

/// The JSON document that `itin viewshed --json` prints, without the call and its outputs. `metadata` is that of the
/// store that the result was computed on.
std::string json_of(const Result& result, const StoreMetadata& metadata);

struct GeotiffOptions {
  std::string crs_wkt;
  std::vector<std::pair<std::string, std::string>> metadata;  ///< added to what the request says of itself
  bool overwrite = false;
};

/// Writes the result with write_raster(). Byte: classes (Verdict, nodata 255; also for kFresnel). UInt16: counts
/// (nodata 65535). UInt32: bits without nodata (0 where none sees, a band for every 32 observers). Float32 (nodata
/// NaN): angles, bands of distance and number of the nearest, and bands of both losses. Throws FileError, Cancelled.
void write_geotiff(const std::string& path, const Result& result, const GeotiffOptions& options,
                   const Progress& progress = NoProgress());

/// Writes what is seen as polygons to a GeoPackage, one per class as write_regions() does. The classes are visible,
/// hidden and undecided; in sight with the zone cut; one for every count, nearest observer or theme that hides; and the
/// cells where `no_data`, if it is given, is 1. Throws FileError.
void write_polygons(const std::string& path, const Result& result, const std::string& crs_wkt, bool overwrite,
                    std::span<const std::uint8_t> no_data = {});

}  // namespace itin::viewshed
