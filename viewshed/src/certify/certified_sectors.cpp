#include "certify/certified_sectors.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <itin/silent_progress.hpp>
#include <viewshed/surface.hpp>

#include "certify/certified_cells.hpp"
#include "certify/surroundings.hpp"
#include "judge/block_judge.hpp"
#include "line/hulls.hpp"
#include "line/infinity.hpp"
#include "plan/sight_sectors.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

class CertifiedSectors {
 public:
  CertifiedSectors(const Store& store, const Request& request, std::uint64_t most_points, Progress& progress)
      : store_(store),
        request_(request),
        most_points_(static_cast<double>(most_points)),
        whole_(certified_request(store, request)),
        points_per_square_metre_(points_per_square_metre(store, whole_.level, request)),
        progress_(progress),
        reading_(progress) {}

  ViewshedWithSurface run() {
    Result& result = computed_.result;
    result.request = request_;
    result.certified = true;
    computed_.whole = false;
    const std::vector<Eye> eyes = eyes_on_surface(store_, request_, Detail::tolerance(0), result.ground_m, progress_);
    computed_.surface =
        std::make_shared<Surface>(Surface{coverage_of(store_, window_of(request_), progress_), nullptr, {}});
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    rises_ = TargetRises(store_, request_, result.grid);
    const std::size_t cells = result.grid.cell_count();
    Stage stage("cells judged", eyes.size() * cells, progress_);
    cells_.emplace(result.grid, tiles_, stage);
    const Surroundings surroundings(store_, request_, result.grid);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      nearby_ = surroundings.decide(request_.observers[i], result.statistics, progress_);
      judge_from(eyes[i]);
      stage.advance_to((i + 1) * cells);
    }
    cells_->store(result);
    result.statistics.lines_seconds += watch_.lap();
    return std::move(computed_);
  }

 private:
  void judge_from(const Eye& eye) {
    SightSectors sectors(computed_.result.grid, eye);
    while (!sectors.empty()) {
      const SightSectors::Sector sector = sectors.next(
          [&](const std::vector<Point2>& hull) { return area_of(hull) * points_per_square_metre_ <= most_points_; });
      judge(eye, envelop(store_, within(sector.hull, eye, whole_), reading_), box_about(sector.hull), sector.parts);
      sectors.remove_decided(sector, kInfinity);
    }
  }

  /// Restricts the request to a sector, without finer ground that lies beside the sector. All finer ground about the
  /// eye belongs to the sector: where the window ends, coarse ground stays beside finer ground, and would hide
  /// everything.
  static EnvelopeRequest within(std::vector<Point2> sector, const Eye& eye, EnvelopeRequest wanted) {
    for (const FineDisc& disc : wanted.discs)
      if (disc.centre == eye.position) add_corners(square_about(disc.centre, disc.radius), sector);
    wanted.window = Window::polygons({{hull_of(std::move(sector)), {}}});
    const Box box = wanted.window.bounds();
    std::erase_if(wanted.discs,
                  [&](const FineDisc& disc) { return !square_about(disc.centre, disc.radius).meets(box); });
    return wanted;
  }

  void judge(const Eye& eye, Envelope envelope, const Box& box, std::span<const Tile> parts) {
    Result& result = computed_.result;
    result.statistics.add_retrieval(envelope.lower.statistics, envelope.lower.triangles.size(), watch_.lap());
    BoundedEnvelope bounded(std::move(envelope), tiles_, rises_);
    bounded.bound(intersection(box, bounded.envelope().lower.bounds()));
    const BlockJudge judge(bounded, request_, result.grid, tiles_, eye, nearby_ ? &*nearby_ : nullptr);
    result.statistics.scene_seconds += watch_.lap();
    cells_->judge(judge, by_tile(parts, tiles_));
    result.statistics.lines_seconds += watch_.lap();
  }

  static Box box_about(std::span<const Point2> hull) {
    Box box;
    for (const Point2& corner : hull) box.extend(corner);
    return box;
  }

  const Store& store_;
  const Request& request_;
  double most_points_;
  EnvelopeRequest whole_;  ///< what all sectors together ask for
  double points_per_square_metre_;
  Progress& progress_;
  SilentProgress reading_;  ///< while a sector is read
  Stopwatch watch_;
  ViewshedWithSurface computed_;
  RasterGrid tiles_;
  TargetRises rises_;
  std::optional<ExactNearby> nearby_;
  std::optional<CertifiedCells> cells_;
};

}  // namespace

ViewshedWithSurface certify_by_sectors(const Store& store, const Request& request, std::uint64_t most_points,
                                       Progress& progress) {
  return CertifiedSectors(store, request, most_points, progress).run();
}

}  // namespace itin::viewshed
