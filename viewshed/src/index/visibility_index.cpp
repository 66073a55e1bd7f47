#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/visibility_sampler.hpp"
#include "progress/stage.hpp"
#include "request/request.hpp"
#include "scene/rays/scene.hpp"

namespace itin::viewshed {

namespace {

constexpr float kNoShare = std::numeric_limits<float>::quiet_NaN();

void validate(const IndexRequest& request) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(what);
  };
  require(std::isfinite(request.cell_size) && request.cell_size > 0, "the cell size must be positive, in metres");
  require(std::isfinite(request.radius) && request.radius > 0, "the radius must be positive, in metres");
  require(request.height >= 0 && request.target_height >= 0, "heights above the ground must not be negative");
  require(request.targets > 0, "at least one target an observer is needed");
  require(request.nodata != NoData::kUnknown, "ground without data must block or be clear for a visibility index");
}

Window with_surroundings(const Window& area, double radius) {
  if (area.is_all()) return area;
  const Box box = area.bounds();
  return Window::box({box.xmin - radius, box.ymin - radius, box.xmax + radius, box.ymax + radius});
}

/// Of targets seen among those on ground: with one more of either kind, so that none or all seen is no certainty.
double standard_error(const VisibilitySampler::Tally& tally) {
  const double n = tally.on_ground + 2, p = (tally.seen + 1) / n;
  return std::sqrt(p * (1 - p) / n);
}

}  // namespace

VisibilityIndex visibility_index(const Store& store, const IndexRequest& request, Progress& progress) {
  validate(request);
  const Window window = with_surroundings(request.area, request.radius);
  const Tin surface = triangulate(store, window, request.detail, progress, request.themes);
  if (surface.triangles.empty()) throw InputError("the area holds no ground");
  Request look;
  look.target_height = std::max(request.height, request.target_height);
  const double ceiling = ceiling_of(surface, look);
  const Scene scene(surface, request.earth, request.nodata, ceiling);
  std::optional<Tin> bare;
  std::optional<Scene> bare_scene;
  if (request.themes.includes_standing(store.metadata().themes)) {
    bare = triangulate(store, window, request.detail, progress, ThemeChoice::none());
    bare_scene.emplace(*bare, request.earth, NoData::kClear, ceiling);
  }
  const Scene& ground = bare_scene ? *bare_scene : scene;

  VisibilityIndex index;
  index.grid = RasterGrid::aligned(request.area.is_all() ? surface.bounds() : request.area.bounds(), request.cell_size);
  index.share.assign(index.grid.cell_count(), kNoShare);
  index.standard_error.assign(index.grid.cell_count(), kNoShare);
  index.triangles = surface.triangles.size();
  index.retrieval = surface.statistics;
  const VisibilitySampler sampler(scene, ground, surface.grid, request.radius, request.target_height, request.targets);
  std::vector<std::uint64_t> rays(static_cast<std::size_t>(index.grid.rows()));
  std::atomic<bool> stands = false;
  for_each_step(rays.size(), "observers", progress, [&](std::size_t row) {
    for (std::int64_t column = 0; column < index.grid.columns(); ++column) {
      const RasterGrid::Cell cell{column, static_cast<std::int64_t>(row)};
      const Point2 place = index.grid.centre(cell.column, cell.row);
      const auto height = lies_in(request.area, place) ? ground.ground(place) : std::nullopt;
      if (!height) continue;
      stands = true;
      const GridPoint seed = surface.grid.quantise({place.x, place.y, 0});
      const VisibilitySampler::Tally tally = sampler.look(
          place, *height + request.height,
          (static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed.x)) << 32) | static_cast<std::uint32_t>(seed.y));
      rays[row] += tally.on_ground;
      if (tally.on_ground == 0) continue;
      index.share[index.grid.index(cell)] = static_cast<float>(tally.seen) / static_cast<float>(tally.on_ground);
      index.standard_error[index.grid.index(cell)] = static_cast<float>(standard_error(tally));
    }
  });
  double variance = 0;
  for (std::size_t i = 0; i < index.share.size(); ++i) {
    if (std::isnan(index.share[i])) continue;
    ++index.observers;
    index.mean += index.share[i];
    variance += double{index.standard_error[i]} * index.standard_error[i];
  }
  for (const std::uint64_t r : rays) index.lines += r;
  if (!stands) throw InputError("no cell's centre lies on ground in the area; give smaller cells");
  if (index.observers == 0)
    throw InputError("no target fell on ground: the radius reaches far beyond it; give a smaller one, or more targets");
  index.mean /= static_cast<double>(index.observers);
  index.mean_error = std::sqrt(variance) / static_cast<double>(index.observers);
  return index;
}

void write_geotiff(const std::string& path, const VisibilityIndex& index, const IndexRequest& request,
                   const GeotiffOptions& options) {
  std::vector<float> values = index.share;
  values.insert(values.end(), index.standard_error.begin(), index.standard_error.end());
  RasterDescription description;
  description.crs_wkt = options.crs_wkt;
  description.nodata = std::numeric_limits<double>::quiet_NaN();
  description.band_name = "share of the ground within the radius that is seen";
  description.further_bands = {"standard error of the share"};
  description.metadata = {{"radius_m", fmt::format("{:g}", request.radius)},
                          {"observer_height_m", fmt::format("{:g}", request.height)},
                          {"target_height_m", fmt::format("{:g}", request.target_height)},
                          {"targets", fmt::format("{}", request.targets)},
                          {"nodata_rule", nodata_text(request.nodata)},
                          {"refraction", request.earth.convention()}};
  description.metadata.insert(description.metadata.end(), options.metadata.begin(), options.metadata.end());
  description.overwrite = options.overwrite;
  write_raster(path, index.grid, values, description);
}

}  // namespace itin::viewshed
