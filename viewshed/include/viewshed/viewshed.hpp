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
// Accuracy: the result is exact for the surface asked for. Each cell has the verdict of its sight line over every
// triangle, decided in double precision. Ground that rises less than a micrometre above a sight line grazes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <viewshed/request.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// Computes a viewshed on a given surface. The Tin must hold every triangle that sight lines cross; where it ends there
/// is no data. Cost: O(n) for n triangles (about 0.1 microseconds each) and about 50 ns per cell and observer, 150 ns
/// in mode kHeight; in mode kLoss each cell takes all triangles under its line, about 60 ns each. Memory: 9 bytes per
/// post of a raster, 50 per triangle of others, and a tenth of a megabyte per thread. The result does not depend on the
/// number of threads. Throws InputError (an observer outside the data, by name; an unusable radius, cell size or angle;
/// more than 65534 observers to count), Cancelled.
Result compute(const Tin& tin, const Request& request, Progress& progress);

/// Computes as above, but ends that are not on the surface stand on `ground`, which must cover what the surface covers.
Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress);

/// Cells of a result that form a rectangle: the north-west one, and those at every `step`-th column and row from it.
struct DecidedCells {
  RasterGrid::Cell north_west;
  std::int64_t columns = 0;  ///< how many of these cells are side by side
  std::int64_t rows = 0;
  std::int64_t step = 1;

  /// The place of the cell in one of these columns and rows.
  RasterGrid::Cell at(std::int64_t column, std::int64_t row) const {
    return {north_west.column + column * step, north_west.row + row * step};
  }
};

/// Gets every rectangle of cells that an observer may see, as soon as all of it is decided. Where the surface fits into
/// the memory at once, the cells come in three passes, each pass with those nearest to an observer first: with `step` 9
/// (1 cell in 81), with 3 (1 in 9), and with 1 (all, those of the passes before among them). On edges that are
/// multiples of the cell size, the cells of a pass share their centres with cells of that many times the size, wherever
/// the request lies. Elsewhere all cells come once, at the end. `result` has the final verdicts of the cells and the
/// values of its mode there, but in mode kBlocker, which numbers blockers at the end. One call at a time, on any
/// thread, which it keeps from deciding other cells meanwhile.
using CellSink = std::function<void(const Result& result, const DecidedCells& cells)>;

struct ComputeOptions {
  // These change the speed, never the answer.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
  bool lattices = true;  ///< a raster is swept over its posts alone
  /// Whether ViewshedWithSurface::surface is wanted as a whole, where the memory holds it, for maps and horizons. If
  /// not, no more of a large surface is read than may be seen.
  bool whole_surface = true;
  CellSink sink = {};  ///< gets cells as they are decided
};

/// The surface over which sight lines were decided. Opaque: draw_map() and compute_on_surface() take it.
struct RetrievedSurface;

/// A result and the surface that it was computed on, for maps and single observers while the store is open.
struct ViewshedWithSurface {
  std::shared_ptr<RetrievedSurface> surface;  ///< a coarse one where that of the request was not read as a whole
  std::optional<Tin> ground;                  ///< what ends stand on, where that is not the surface
  bool whole = true;                          ///< `surface` is that of the request
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

}  // namespace itin::viewshed
