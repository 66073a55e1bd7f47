// What a viewshed tells: the verdict on every cell, and what its mode tells besides.
//
//   const viewshed::Result result = viewshed::compute(store, request, progress);
//   const std::size_t cell = result.grid.index(result.grid.cell_at({318500, 176500}).value());
//   if (result.visible[cell] == viewshed::Verdict::kVisible) std::cout << "in sight\n";
//   std::cout << result.cells.visible << " of " << result.cells.in_view() << " cells\n";
//   // In mode kHeight:
//   const float least = result.get<viewshed::LeastHeights>().height_m[cell];
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

/// Says whether a line of sight is clear, or the zone about it, as far as that is known. Rasters hold these numbers.
enum class Verdict : std::uint8_t {
  kHidden = 0,
  kVisible = 1,
  kUndecided = 2,  ///< at the detail asked for, or for want of ground
  kZoneCut = 3,    ///< in sight, but something rises into the Fresnel zone; kFresnel alone
  kOutside = 255   ///< outside every field of view, or no ground to look at
};

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
/// kLevel: the level at the receiver in clear air, by profile::link_budget() with the losses of kLoss, of the observer
/// for whom it is greatest; NaN where kLoss has no value.
struct Levels {
  std::vector<float> level_dbm;
  /// With rain and a sensitivity: the minutes of an average year in which rain takes more than the margin; less than
  /// 0.001 % of the year counts as 0.001 %, 5.26 minutes. NaN where the level is not above the sensitivity, where rain
  /// takes more for over 1 % of the year, and beyond the lengths and frequencies of P.530. Otherwise empty.
  std::vector<float> outage_minutes;
  /// Which observer it is, its number from 1 in their order; 0 where the level has no value. Of equal levels, the one
  /// with the least outage counts, and then the first.
  std::vector<std::uint32_t> observer;
};
/// The values of a mode; kVisible and kFresnel have none.
using ModeValues = std::variant<std::monostate, Counts, ObserverSets, Angles, NearestObservers, Blockers, LeastHeights,
                                Probabilities, Losses, Levels>;

class ResultParts;

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
  /// Not null: `visible` and `values` are empty, and are had from here part by part.
  std::shared_ptr<const ResultParts> parts;

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

/// The cells of a result that does not hold them in memory, since they are many.
class ResultParts {
 public:
  /// Takes a part: a result of the same request on some of the cells, of which the first is here in the whole grid.
  using Take = std::function<void(const Result& part, RasterGrid::Cell north_west)>;

  virtual ~ResultParts() = default;
  /// Calls take() for each part. Cells that belong to none are outside. Throws FileError where parts can no longer be
  /// read.
  virtual void for_each(const Take& take) const = 0;
};

/// How much of what observers look at has no ground: no data, and so neither seen nor hidden.
struct MissingGround {
  std::uint64_t without_ground = 0;  ///< cells of the raster that an observer looks at, and that have no ground
  std::uint64_t with_ground = 0;     ///< cells of the raster that an observer looks at, and that have ground
  std::uint64_t beyond = 0;          ///< cells of that size within observers' radii, but beyond the raster
  double cell_area = 0;              ///< square metres; 0 where targets at random are counted in place of cells
  bool bounded = true;               ///< the request limits how far observers look; else: as far as there is ground

  /// The share without ground of all that observers look at, 0 to 1.
  double share() const;
  double study_m2() const { return static_cast<double>(with_ground + without_ground + beyond) * cell_area; }
  double missing_m2() const { return static_cast<double>(without_ground + beyond) * cell_area; }
  /// The share as text: "12.3 %", "less than 0.1 %", "more than 99.9 %".
  std::string percent() const;
  /// The share and its area: "12.3 % (4.6 km²)"; the share alone where no cells are counted.
  std::string text() const;
  /// The text about it in a map's legend: "No ground data: 12.3 % (4.6 km²) of `area`".
  std::string key_text(const std::string& area) const;
  /// A warning that says what share of `area` has no ground, and what can be done about it; nothing where that is less
  /// than a thousandth, or the area is wherever there is ground.
  std::optional<std::string> warning(const std::string& area) const;
};

}  // namespace itin::viewshed
