#include "exact/prepared_surface.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <itin/call_progress.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/surface_heights.hpp"
#include "progress/stopwatch.hpp"
#include "request/eye.hpp"
#include "request/request.hpp"
#include "request/void_shadow.hpp"
#include "run/surface_source.hpp"
#include "scene/exact_scene.hpp"
#include "scene/reveal.hpp"

namespace itin::viewshed {

namespace {

class SurfaceAtOnce final : public SurfaceSource {
 public:
  /// `over` must outlive it.
  explicit SurfaceAtOnce(const PreparedSurface& over) : over_(over) {}

  std::vector<Eye> begin(Result& result, CallProgress& call) override {
    Stopwatch watch;
    call.report("scene", 0);
    const Request& request = result.request;
    take_statistics(result);
    result.grid = cells_of(request, over_.extent);
    tiles_ = grid_of_tiles(result.grid);
    if (over_.reader != nullptr && asks_for_all_heights(request)) over_.reader->read_all(call);
    surface_.emplace(heights_for_cells(result.grid), over_.tin, request.targets_on_surface ? nullptr : over_.bare,
                     over_.ground, request.earth, result.grid, tiles_);
    if (casts_rays(request)) surface_->cast_rays(request.earth);
    const std::vector<Eye> eyes = stand_on_ground(result, call);
    find_voids(over_.units(), surface_->rim(), result);
    if (needs_triangles(request)) studies_.emplace(request, finders(), bare_finders(), call);
    result.statistics.scene_seconds = watch.lap();
    if (over_.reader != nullptr && !all_read(*over_.reader))
      for (const Eye& eye : eyes) revealed_.push_back(reveal(eye, *over_.reader, *surface_, kAnyTiles, call).view);
    result.statistics.lines_seconds = watch.lap();
    return eyes;
  }

  /// A tile's ground is found anew for each group of eyes; the views of so many are in memory at a time.
  std::size_t eyes_at_once() const override { return 256; }

  bool decides_all_cells() const override { return true; }

  bool decide(const EyeGroup& group, ViewshedCells& cells) override {
    Stopwatch watch;
    Result& result = cells.result();
    const ExactJudge judge(*surface_, make_views(group.eyes.size(), [&](std::size_t i) {
      const Eye& eye = group.eyes[i];
      return EyeView{eye, view_of(eye, group.first + i, cells.progress()), shadow_of(eye, surface_->rim(), result)};
    }));
    cells.observe_all({judge, group.first, studies_ ? &*studies_ : nullptr, group.last});
    result.statistics.lines_seconds += watch.lap();
    return true;
  }

 private:
  const TriangleFinders& finders() { return over_.finders != nullptr ? *over_.finders : finders_.emplace(*over_.tin); }
  const TriangleFinders* bare_finders() {
    if (over_.bare_finders != nullptr || over_.bare == nullptr) return over_.bare_finders;
    return &bare_finders_.emplace(*over_.bare);
  }

  void take_statistics(Result& result) const {
    Statistics& statistics = result.statistics;
    statistics.triangles = over_.lattice != nullptr ? over_.lattice->triangle_count() : over_.tin->triangles.size();
    statistics.retrieval = over_.lattice != nullptr ? over_.lattice->statistics : over_.tin->statistics;
    if (statistics.triangles == 0)
      eye_of(over_.units(), result.request, result.request.observers.front(), std::nullopt);
  }

  std::shared_ptr<BinnedHeights> heights_for_cells(const RasterGrid& grid) const {
    if (over_.heights) return over_.heights;
    return over_.tin != nullptr ? std::make_shared<BinnedHeights>(*over_.tin, grid.cell_area())
                                : std::make_shared<BinnedHeights>(*over_.lattice);
  }

  std::vector<Eye> stand_on_ground(Result& result, Progress& progress) {
    std::vector<Eye> eyes;
    const Request& request = result.request;
    for (const Observer& observer : request.observers) {
      const bool raised = request.observers_on_surface || over_.bare == nullptr;
      if (over_.reader != nullptr) reveal_place(observer.position, *over_.reader, *surface_, progress);
      const auto height = raised ? surface_->height(observer.position) : height_on(*over_.bare, observer.position);
      eyes.push_back(eye_of(over_.units(), request, observer, height));
      result.ground_m.push_back(*height);
    }
    return eyes;
  }

  RadialSweep::View view_of(const Eye& eye, std::size_t number, const Progress& progress) {
    return revealed_.empty() ? surface_->view_of_cells(eye, progress) : std::move(revealed_[number]);
  }

  const PreparedSurface& over_;
  RasterGrid tiles_;
  std::optional<ExactScene> surface_;
  std::optional<TriangleFinders> finders_, bare_finders_;  ///< where `over_` has none
  std::optional<TriangleStudies> studies_;
  std::vector<RadialSweep::View> revealed_;  ///< each eye's, where not all heights have been read; else none
};

}  // namespace

Result compute(const PreparedSurface& over, const Request& request, Progress& progress, const CellSink& sink) {
  validate(request);
  SurfaceAtOnce source(over);
  CallProgress call(progress);
  Result result = *run(source, request, sink, call);
  call.finish();
  return result;
}

Result compute(const Tin& tin, const Request& request, Progress& progress) {
  return compute(PreparedSurface{.tin = &tin, .extent = tin.bounds()}, request, progress);
}

Result compute(const Tin& tin, const Tin& ground, const Request& request, Progress& progress) {
  return compute(PreparedSurface{.tin = &tin, .bare = &ground, .extent = tin.bounds()}, request, progress);
}

Result compute(const RetrievedSurface& surface, const Tin* ground, const Request& request, Progress& progress,
               const CellSink& sink) {
  PreparedSurface over{.bare = ground, .extent = surface.extent};
  if (surface.lattice) {
    over.reader = surface.lattice.get(), over.lattice = &surface.lattice->lattice();
  } else {
    over.tin = &surface.tin;
  }
  if (over.extent.empty()) over.extent = over.lattice != nullptr ? over.lattice->bounds() : over.tin->bounds();
  return compute(over, request, progress, sink);
}

}  // namespace itin::viewshed
