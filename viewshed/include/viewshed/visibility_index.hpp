// How much is seen from everywhere in an area: the total viewshed, as a visibility index (Franklin and Ray 1994).
//
//   viewshed::IndexRequest request;
//   request.area = Window::box({304000, 181000, 324000, 201000});
//   request.cell_size = 250;
//   const viewshed::VisibilityIndex index = viewshed::visibility_index(store, request, progress);
//   viewshed::write_geotiff("index.tif", index, request, {.crs_wkt = store.metadata().crs_wkt});
//
// Every cell's centre is an observer's place. The share of the ground within the radius that is seen from it is
// estimated, and comes with its standard error. Both ends of sight lines stand on the ground, and what the themes have
// standing there hides. Each sight line is decided as viewsheds decide theirs.
//
// Where the surface is that of a raster's posts, and cells are a multiple of what lies between these, every observer
// looks along rays, evenly spread over all directions. Each ray looks at the ground in the middle of rings about the
// observer, which are as wide as the distance between posts at most, and a look counts as much as its ring has area.
// Elsewhere targets are drawn at random, evenly spread over the disc.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <itin/window.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

struct IndexRequest {
  Window area = {};        ///< where observers are: cells whose centre lies in it; all(): the whole coverage
  double cell_size = 100;  ///< metres
  double height = 2;       ///< observers' height above the ground, metres
  double target_height = 0;
  double radius = 5000;  ///< metres
  /// How many rays each observer looks along, at least 8, or how many targets at random it has. Of neither: 128 rays
  /// where they can be, else 128 targets.
  std::optional<unsigned> rays = {}, targets = {};
  Earth earth = {};
  Detail detail = Detail::tolerance(0);
  ThemeChoice themes = ThemeChoice::none();
  NoData nodata = NoData::kUnknown;
  /// About how much memory to work in. Where it does not hold all ground at once, the ground is read for one block of
  /// observers after another.
  std::uint64_t memory_bytes = ComputeOptions().memory_bytes;
};

/// How each observer looks about.
struct IndexSample {
  unsigned rays = 0;              ///< 0 where targets are drawn
  unsigned targets = 0;           ///< at random; 0 where rays are looked along
  std::string without_rays = {};  ///< why there are no rays, where the request leaves the choice; else empty
};

class IndexParts;

struct VisibilityIndex {
  RasterGrid grid;
  IndexSample sample;
  /// What is seen of the ground within the radius, 0 to 1; NaN outside the area and where there is no ground.
  std::vector<float> share;
  /// By rays: from how much each differs from its neighbours. By targets: sqrt(p (1 - p) / n) of the share p, with one
  /// target more of either kind.
  std::vector<float> standard_error;
  std::vector<float> undecided;  ///< share that ground without data alone could hide, under kUnknown; NaN likewise
  double mean = 0;               ///< the share seen, averaged over the cells
  double mean_error = 0;         ///< the standard error of the mean, for these cells
  double mean_undecided = 0;
  std::uint64_t observers = 0;
  std::uint64_t targets = 0;  ///< looked at within the radius of all observers, on ground or not
  std::uint64_t lines = 0;    ///< sight lines to the targets that are on ground
  double ground = 1;          ///< the share of what lies within the radius that is ground, over all observers
  std::uint64_t triangles = 0;
  RetrievalStatistics retrieval;
  /// Not null: `share`, `standard_error` and `undecided` are empty, and are had from here part by part.
  std::shared_ptr<const IndexParts> parts;
};

/// The cells of an index that does not hold them in memory, since they are many.
class IndexParts {
 public:
  /// Takes the grids of a part of the cells, of which the first is here in the whole grid.
  using Take = std::function<void(const VisibilityIndex& part, RasterGrid::Cell north_west)>;

  virtual ~IndexParts() = default;
  /// Calls take() for each part. Cells that belong to none have no observer. Throws FileError where parts can no longer
  /// be read.
  virtual void for_each(const Take& take) const = 0;
};

/// Computes the visibility index. A store and a request always give the same numbers, whatever the number of threads
/// and the memory: SightLine decides each line, as in every viewshed. Cost: retrieval of the observers' cells and the
/// radius about them, and one to two microseconds per target, or some nanoseconds for each ring of a ray. Throws
/// InputError (values out of range, rays where there can be none, no ground in the area, too little memory for a single
/// observer or the rasters), and what triangulate() throws.
VisibilityIndex visibility_index(const Store& store, const IndexRequest& request, Progress& progress);

/// Writes three bands, Float32: the share, its standard error and the share undecided; nodata NaN. Throws FileError,
/// Cancelled.
void write_geotiff(const std::string& path, const VisibilityIndex& index, const IndexRequest& request,
                   const GeotiffOptions& options, const Progress& progress = NoProgress());

}  // namespace itin::viewshed
