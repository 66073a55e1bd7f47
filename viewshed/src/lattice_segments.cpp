#include "lattice_segments.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <itin/error.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "boundary.hpp"
#include "cell_box.hpp"
#include "full_surface.hpp"
#include "hulls.hpp"
#include "near_ground.hpp"
#include "observation.hpp"
#include "request.hpp"
#include "reveal.hpp"
#include "stopwatch.hpp"
#include "store_viewshed.hpp"
#include "void_shadow.hpp"

namespace itin::viewshed {

namespace {

/// Of a post whose height is not read: a bit, and its share of a leaf and of a tile.
constexpr std::uint64_t kBytesAnUnreadPost = 1;
/// Posts of a segment that is begun take at least so much: some of them will be read.
constexpr std::uint64_t kLeastBytesAPost = 3;
/// Of the surface that maps are drawn over, at most.
constexpr std::uint64_t kCoarsePoints = 200000;

using Tiles = std::span<const std::size_t>;

/// Passes on that a call is to end, and nothing of how far it has come.
class Unreported final : public Progress {
 public:
  explicit Unreported(const Progress& whole) : whole_(whole) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return whole_.cancelled(); }

 private:
  const Progress& whole_;
};

class LatticeSegments {
 public:
  LatticeSegments(const Store& store, const Request& request, std::uint64_t memory, Progress& progress)
      : store_(store),
        request_(request),
        memory_(memory),
        all_heights_(asks_for_all_heights(request)),
        progress_(progress),
        reading_(progress) {}

  std::optional<Surveyed> run() {
    Result& result = surveyed_.result;
    result.request = request_;
    const std::vector<Eye> eyes = eyes_on_full_surface(store_, request_, result.ground_m, progress_);
    retrieve_coarse();
    observations_ = Observations(request_).of_tiles(tiles_);
    for (std::uint32_t i = 0; i < eyes.size(); ++i)
      if (!look(eyes[i], i, by_azimuth(eyes[i]))) return std::nullopt;
    store_all(observations_, tiles_, result);
    result.statistics.rays_seconds += watch_.lap();
    return std::move(surveyed_);
  }

 private:
  void retrieve_coarse() {
    Result& result = surveyed_.result;
    const Box box = box_of_window(store_, request_);
    int level = static_cast<int>(store_.metadata().levels.size()) - 1;
    while (level > 0 && store_.points_about(level - 1, box) <= kCoarsePoints) --level;
    Tin& coarse = surveyed_.surface.tin;
    coarse = triangulate(store_, window_of(request_),
                         Detail::tolerance(store_.metadata().levels[static_cast<std::size_t>(level)].tolerance),
                         progress_, ThemeChoice::none());
    result.grid = cells_of(request_, coarse.bounds());
    tiles_ = grid_of_tiles(result.grid);
    look_for_voids(coarse.grid, rim_of(coarse, boundary_edges(coarse)), result);
    posts_a_square_metre_ = static_cast<double>(store_.points_about(0, box)) / (box.width() * box.height());
    result.statistics.retrieval_seconds += watch_.lap();
  }

  /// The tiles of cells that an eye looks at. By rings of doubling distances, for the nearer ones span wide sectors.
  std::vector<std::size_t> by_azimuth(const Eye& eye) const {
    struct Place {
      int ring;
      double azimuth;
      std::size_t tile;
    };
    std::vector<Place> places;
    for (std::size_t tile = 0; tile < tiles_.cell_count(); ++tile) {
      const Box box = cell_box(tiles_, tile);
      const double dx = eye.position.x - std::clamp(eye.position.x, box.xmin, box.xmax),
                   dy = eye.position.y - std::clamp(eye.position.y, box.ymin, box.ymax);
      if (!eye.view.reaches(dx * dx + dy * dy)) continue;
      const double azimuth =
          std::atan2((box.xmin + box.xmax) / 2 - eye.position.x, (box.ymin + box.ymax) / 2 - eye.position.y);
      places.push_back({std::ilogb(std::max(1.0, std::hypot(dx, dy) / tiles_.cell_width())), azimuth, tile});
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return std::tie(a.ring, a.azimuth, a.tile) < std::tie(b.ring, b.azimuth, b.tile);
    });
    std::vector<std::size_t> tiles;
    for (const Place& place : places) tiles.push_back(place.tile);
    return tiles;
  }

  /// False where the surface is no lattice.
  bool look(const Eye& eye, std::uint32_t observer, Tiles tiles) {
    if (tiles.empty()) return true;
    const std::vector<Point2> hull = hull_of(eye, tiles);
    const std::uint64_t least = all_heights_ ? kBytesAPost : kLeastBytesAPost;
    const double share =
        area_of(hull) * posts_a_square_metre_ * static_cast<double>(least) / static_cast<double>(memory_);
    // Of what cannot be divided any more the estimate may be wrong.
    if (share < (tiles.size() == 1 ? 2 : 1)) {
      const auto reader = LatticeReader::open(
          store_, Window::polygons({{hull, {}}}), ThemeChoice::none(),
          all_heights_ ? LatticeReader::Heights::kAll : LatticeReader::Heights::kNone, kAnyLattice, reading_);
      if (!reader) return false;
      if (look_over(*reader, eye, observer, tiles)) return true;
    }
    if (tiles.size() == 1)
      throw InputError("the sight lines to some cells do not fit into the memory: give more --memory or smaller cells");
    const std::size_t half = tiles.size() / 2;
    return look(eye, observer, tiles.first(half)) && look(eye, observer, tiles.subspan(half));
  }

  /// False where what the eye may see does not fit into the memory.
  bool look_over(LatticeReader& reader, const Eye& eye, std::uint32_t observer, Tiles tiles) {
    Result& result = surveyed_.result;
    FullSurface surface(reader.lattice(), request_.earth, result.grid, tiles_);
    const std::uint64_t unread = kBytesAnUnreadPost * reader.lattice().triangle_count() / 2;
    const auto view =
        reveal(eye, reader, surface, (memory_ - std::min(memory_, unread)) / (kBytesAPost * LatticeTin::kCells));
    if (!view) return false;
    std::optional<VoidShadow> shadow;
    if (request_.nodata == NoData::kBlock && result.crosses_voids) shadow.emplace(surface.rim(), eye.units);
    result.statistics.retrieval += reader.lattice().statistics;
    result.statistics.triangles += reader.lattice().triangle_count();
    result.statistics.retrieval_seconds += watch_.lap();
    std::atomic<std::uint64_t> lines = 0;
    parallel_for(tiles.size(), [&](std::size_t i) {
      progress_.throw_if_cancelled();
      const auto work = surface.begin(tiles[i]);
      lines += observations_[tiles[i]]->look({surface, eye, *view, observer, shadow ? &*shadow : nullptr, *work});
    });
    result.statistics.rays += lines;
    result.statistics.rays_seconds += watch_.lap();
    done_ += tiles.size();
    progress_.report("cells decided",
                     static_cast<double>(done_) / static_cast<double>(tiles_.cell_count() * request_.observers.size()));
    return true;
  }

  std::vector<Point2> hull_of(const Eye& eye, Tiles tiles) const {
    std::vector<Point2> corners{eye.position};
    for (const std::size_t tile : tiles) add_corners(cell_box(tiles_, tile), corners);
    return viewshed::hull_of(std::move(corners));
  }

  static double area_of(const std::vector<Point2>& ring) {
    double doubled = 0;
    for (std::size_t i = 2; i < ring.size(); ++i) doubled += left_of(ring[0], ring[i - 1], ring[i]);
    return doubled / 2;
  }

  const Store& store_;
  const Request& request_;
  std::uint64_t memory_;
  bool all_heights_;
  Progress& progress_;
  Unreported reading_;  ///< of a segment
  Stopwatch watch_;
  Surveyed surveyed_;
  RasterGrid tiles_;
  double posts_a_square_metre_ = 0;
  std::size_t done_ = 0;                                    ///< tiles, of all observers
  std::vector<std::unique_ptr<Observation>> observations_;  ///< a tile
};

}  // namespace

std::optional<Surveyed> compute_in_lattice_segments(const Store& store, const Request& request, std::uint64_t memory,
                                                    Progress& progress) {
  if (needs_tin(request) || features_stand(store, request)) return std::nullopt;
  return LatticeSegments(store, request, memory, progress).run();
}

}  // namespace itin::viewshed
