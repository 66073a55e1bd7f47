#include "certify/level_source.hpp"

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/silent_progress.hpp>
#include <viewshed/surface.hpp>

#include "certify/surroundings.hpp"
#include "judge/block_judge.hpp"
#include "line/hulls.hpp"
#include "line/infinity.hpp"
#include "plan/effort.hpp"
#include "plan/sight_sectors.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "run/surface_source.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

class LevelSource : public SurfaceSource {
 public:
  LevelSource(const Store& store, const Request& request, const Progress& progress)
      : store_(store), request_(request), reading_(progress) {}

  std::vector<Eye> begin(Result& result, CallProgress& call) override {
    std::vector<Eye> eyes = eyes_on_surface(store_, request_, Detail::tolerance(0), result.ground_m, call);
    result.certified = true;
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    rises_ = TargetRises(store_, request_, result.grid);
    surroundings_.emplace(store_, request_, result.grid);
    read(result, call);
    return eyes;
  }

  bool decide(const EyeGroup& group, ViewshedCells& cells) override {
    nearby_ = surroundings_->decide(request_.observers[group.first], cells.result().statistics, reading_);
    judge_from(group.eyes.front(), cells);
    return true;
  }

  /// The surface that maps are drawn over.
  virtual Tin coarse() const = 0;

 protected:
  virtual void read(Result& result, CallProgress& call) = 0;
  virtual void judge_from(const Eye& eye, ViewshedCells& cells) = 0;

  BoundedEnvelope bounded(const EnvelopeRequest& wanted, Statistics& statistics, Progress& progress) {
    Envelope envelope = envelop(store_, wanted, progress);
    statistics.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch_.lap());
    return BoundedEnvelope(std::move(envelope), tiles_, rises_);
  }

  /// Judges cells over what has been bounded of the level.
  void judge(const BoundedEnvelope& over, const Eye& eye, std::span<const PartsOfTile> parts, ViewshedCells& cells) {
    Result& result = cells.result();
    const BlockJudge judge(over, request_, result.grid, tiles_, eye, nearby_ ? &*nearby_ : nullptr);
    result.statistics.scene_seconds += watch_.lap();
    cells.judge(judge, parts);
    result.statistics.lines_seconds += watch_.lap();
  }

  const Store& store_;
  const Request& request_;
  SilentProgress reading_;  ///< while less than the whole level is read
  RasterGrid tiles_;

 private:
  Stopwatch watch_;
  TargetRises rises_;
  std::optional<Surroundings> surroundings_;
  std::optional<ExactNearby> nearby_;  ///< what lies near the eye that is looked from
};

class WholeLevel final : public LevelSource {
 public:
  using LevelSource::LevelSource;
  Tin coarse() const override { return level_->envelope().lower; }

 private:
  void read(Result& result, CallProgress& call) override {
    const EnvelopeRequest wanted = certified_request(store_, request_);
    const std::uint64_t points = store_.points_about(wanted.level, box_of_window(store_, request_));
    const Effort effort = effort_of_viewshed(request_, points, result.grid.cell_count(), SurfaceForm::kTriangles);
    level_.emplace(bounded(wanted, result.statistics, call.step(effort.share_of_reading())));
  }

  void judge_from(const Eye& eye, ViewshedCells& cells) override {
    level_->bound_for(eye);
    judge(*level_, eye, tiles_in_reach(eye, cells.result().grid), cells);
  }

  std::vector<PartsOfTile> tiles_in_reach(const Eye& eye, const RasterGrid& grid) const {
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < tiles_.cell_count(); ++i)
      if (eye.view.reaches(squared_distance(eye.position, box_of_centres(grid, tile_at(grid, tiles_, i)))))
        within.push_back(i);
    return all_cells(grid, tiles_, within);
  }

  std::optional<BoundedEnvelope> level_;
};

class LevelBySectors final : public LevelSource {
 public:
  LevelBySectors(const Store& store, const Request& request, std::uint64_t most_points, const Progress& progress)
      : LevelSource(store, request, progress),
        most_points_(static_cast<double>(most_points)),
        whole_(certified_request(store, request)),
        points_per_square_metre_(points_per_square_metre(store, whole_.level, request)) {}

  Tin coarse() const override { return coverage_; }

 private:
  void read(Result&, CallProgress& call) override { coverage_ = coverage_of(store_, window_of(request_), call); }

  void judge_from(const Eye& eye, ViewshedCells& cells) override {
    SightSectors sectors(cells.result().grid, eye);
    while (!sectors.empty()) {
      const SightSectors::Sector sector = sectors.next(
          [&](const std::vector<Point2>& hull) { return area_of(hull) * points_per_square_metre_ <= most_points_; });
      BoundedEnvelope within = bounded(wanted_within(sector.hull, eye), cells.result().statistics, reading_);
      within.bound(intersection(box_about(sector.hull), within.envelope().lower.bounds()));
      judge(within, eye, by_tile(sector.parts, tiles_), cells);
      sectors.remove_decided(sector, kInfinity);
    }
  }

  /// Restricts the request to a sector, without finer ground that lies beside the sector. All finer ground about the
  /// eye belongs to the sector: where the window ends, coarse ground stays beside finer ground, and would hide
  /// everything.
  EnvelopeRequest wanted_within(std::vector<Point2> sector, const Eye& eye) const {
    EnvelopeRequest wanted = whole_;
    for (const FineDisc& disc : wanted.discs)
      if (disc.centre == eye.position) add_corners(square_about(disc.centre, disc.radius), sector);
    wanted.window = Window::polygons({{hull_of(std::move(sector)), {}}});
    const Box box = wanted.window.bounds();
    std::erase_if(wanted.discs,
                  [&](const FineDisc& disc) { return !square_about(disc.centre, disc.radius).meets(box); });
    return wanted;
  }

  static Box box_about(std::span<const Point2> hull) {
    Box box;
    for (const Point2& corner : hull) box.extend(corner);
    return box;
  }

  double most_points_;
  EnvelopeRequest whole_;  ///< what all sectors together ask for
  double points_per_square_metre_;
  Tin coverage_;
};

ViewshedWithSurface certify(LevelSource& source, const Request& request, const CellSink& sink, Progress& progress) {
  Result result = *run(source, request, sink, progress);
  return {std::make_shared<RetrievedSurface>(RetrievedSurface{source.coarse(), nullptr, {}}), std::nullopt, false,
          std::move(result)};
}

}  // namespace

ViewshedWithSurface certify_by_blocks(const Store& store, const Request& request, const CellSink& sink,
                                      Progress& progress) {
  WholeLevel source(store, request, progress);
  return certify(source, request, sink, progress);
}

ViewshedWithSurface certify_by_sectors(const Store& store, const Request& request, std::uint64_t most_points,
                                       const CellSink& sink, Progress& progress) {
  LevelBySectors source(store, request, most_points, progress);
  return certify(source, request, sink, progress);
}

}  // namespace itin::viewshed
