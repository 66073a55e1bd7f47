#include "compute/lattice_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/level_choice.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "bounds/boundary.hpp"
#include "compute/store_viewshed.hpp"
#include "line/hulls.hpp"
#include "modes/observe.hpp"
#include "plan/sight_sectors.hpp"
#include "progress/stage.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"
#include "scene/reveal.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// A post whose height is not read takes a bit, and its share of a leaf and of a tile.
constexpr double kBytesPerUnreadPost = 0.5;
/// The share of a sector's tiles that counts as seen before any sector has been computed.
constexpr double kFirstShareSeen = 0.25;
/// About the share of the time that the coarse surface takes.
constexpr double kCoarseSurface = 0.05;
/// The surface that maps are drawn over has at most this many points.
constexpr std::uint64_t kCoarsePoints = 200000;

class LatticeSectors {
 public:
  LatticeSectors(const Store& store, const Request& request, std::uint64_t memory, Progress& progress)
      : store_(store),
        request_(request),
        memory_(memory),
        all_heights_(asks_for_all_heights(request)),
        share_seen_(all_heights_ ? 1 : kFirstShareSeen),
        progress_(progress),
        reading_(progress) {}

  std::optional<ViewshedWithSurface> run() {
    Result& result = computed_.result;
    result.request = request_;
    computed_.whole = false;
    const std::vector<Eye> eyes = eyes_on_surface(store_, request_, Detail::tolerance(0), result.ground_m, progress_);
    progress_.step(kCoarseSurface);
    retrieve_coarse();
    Observations observations(request_);
    observations_ = observations.of_tiles(tiles_);
    stage_.emplace("cells decided", eyes.size() * result.grid.cell_count(), progress_.step(1));
    for (std::uint32_t i = 0; i < eyes.size(); ++i)
      if (!observe_from(eyes[i], i)) return std::nullopt;
    store_all(observations_, tiles_, result);
    observations.finish(result);
    result.statistics.lines_seconds += watch_.lap();
    return std::move(computed_);
  }

 private:
  void retrieve_coarse() {
    Result& result = computed_.result;
    const Box box = box_of_window(store_, request_);
    const int level = finest_level_of(store_, box, kCoarsePoints);
    computed_.surface = std::make_shared<Surface>();
    Tin& coarse = computed_.surface->tin;
    coarse =
        triangulate(store_, window_of(request_), detail_of(store_.metadata(), level), progress_, ThemeChoice::none());
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    find_voids(coarse.grid, rim_of(coarse, boundary_edges(coarse)), result);
    posts_per_square_metre_ = points_per_square_metre(store_, 0, request_);
    tile_side_m_ = LatticeTin::kSide / std::sqrt(posts_per_square_metre_);
    result.statistics.retrieval_seconds += watch_.lap();
  }

  /// Observes all that one eye looks at. Returns false where the surface is no lattice.
  bool observe_from(const Eye& eye, std::uint32_t observer) {
    SightSectors sectors(computed_.result.grid, eye);
    while (!sectors.empty()) {
      const SightSectors::Sector sector = sectors.next([&](const std::vector<Point2>& hull) {
        return bytes_of(hull, share_seen_) <= static_cast<double>(memory_) && has_numbers(hull);
      });
      double reach = 0;
      // The estimate may be wrong, but not by a factor of two.
      if (bytes_of(sector.hull, all_heights_ ? 1 : 0) <= 2 * static_cast<double>(memory_)) {
        const auto reader = LatticeReader::open(
            store_, Window::polygons({{sector.hull, {}}}), ThemeChoice::none(),
            all_heights_ ? LatticeReader::Heights::kAll : LatticeReader::Heights::kNone, kAnyLattice, reading_);
        // Later sectors may have too many tiles.
        if (!reader && (!is_lattice_ || sector.parts.size() == 1)) return false;
        if (reader) {
          is_lattice_ = true;
          reach = observe_over(*reader, eye, observer, sectors, sector.parts);
          learn(reader->lattice(), std::isinf(reach));
        }
      }
      sectors.remove_decided(sector, reach);
    }
    stage_->advance_to((observer + 1) * computed_.result.grid.cell_count());
    return true;
  }

  /// Tells whether the lattice about the hull has no more tiles than can be counted.
  bool has_numbers(const std::vector<Point2>& hull) const {
    Box box;
    for (const Point2& p : hull) box.extend(p);
    return (box.width() / tile_side_m_ + 2) * (box.height() / tile_side_m_ + 2) < LatticeTin::kMostTiles;
  }

  /// The memory that a sector takes if this share of its tiles is seen.
  double bytes_of(const std::vector<Point2>& hull, double share) const {
    const double posts = area_of(hull) * posts_per_square_metre_;
    // The number of a lattice's tiles that a convex shape meets on average, over all places and directions.
    const double side = tile_side_m_;
    const double tiles = area_of(hull) / (side * side) + 2 * length_of(hull) / (std::numbers::pi * side) + 1;
    return kBytesPerUnreadPost * posts + share * tiles * LatticeTin::kCells * kBytesPerPost;
  }

  /// Learns from a sector for the next one, which will be like it, but not quite.
  void learn(const LatticeTin& lattice, bool fits) {
    tile_side_m_ = LatticeTin::kSide * lattice.spacing * lattice.grid.resolution;
    if (all_heights_) return;
    double tiles = 0, seen = 0;
    for (const LatticeTin::Tile& tile : lattice.tiles) {
      if (tile.ground == LatticeTin::Ground::kNone) continue;
      tiles += 1, seen += tile.heights ? 1 : 0;
    }
    share_seen_ =
        std::min(1.0, fits ? (share_seen_ + 1.1 * seen / tiles) / 2 : 1.5 * std::max(share_seen_, seen / tiles));
  }

  /// Decides the cells within a reach, as far as what the eye may see fits into the memory. Returns the reach, metres.
  double observe_over(LatticeReader& reader, const Eye& eye, std::uint32_t observer, const SightSectors& sectors,
                      std::span<const Tile> parts) {
    Result& result = computed_.result;
    FullSurface surface(reader.lattice(), request_.earth, result.grid, tiles_);
    const double unread = kBytesPerUnreadPost * static_cast<double>(reader.lattice().triangle_count()) / 2;
    const double tiles =
        (static_cast<double>(memory_) - unread) / static_cast<double>(kBytesPerPost * LatticeTin::kCells);
    Revealed revealed = reveal(eye, reader, surface, static_cast<std::uint64_t>(std::max(0.0, tiles)), reading_);
    // The reach is a bin less, against rounding.
    const double reach = (revealed.reach - 1) * reader.lattice().spacing * reader.lattice().grid.resolution;
    result.statistics.add_retrieval(reader.lattice().statistics, reader.lattice().triangle_count(), watch_.lap());
    std::vector<Tile> decided;
    std::copy_if(parts.begin(), parts.end(), std::back_inserter(decided),
                 [&](const Tile& part) { return sectors.within(reach, part); });
    const std::vector<PartsOfTile> cells = by_tile(decided, tiles_);
    const ExactJudge judge(surface, {eye, std::move(revealed.view), shadow_of(eye, surface.rim(), result)});
    result.statistics.lines += observe(judge, observer, cells, observations_, nullptr, *stage_);
    result.statistics.lines_seconds += watch_.lap();
    return reach;
  }

  const Store& store_;
  const Request& request_;
  std::uint64_t memory_;
  bool all_heights_;
  double share_seen_;  ///< the part of a sector's tiles that is seen, as far as it is known
  CallProgress progress_;
  SilentProgress reading_;  ///< while a sector is read
  Stopwatch watch_;
  ViewshedWithSurface computed_;
  RasterGrid tiles_;
  double posts_per_square_metre_ = 0;
  double tile_side_m_ = 0;                                  ///< the side of the lattice's tiles, as far as it is known
  bool is_lattice_ = false;                                 ///< as far as has been read
  std::optional<Stage> stage_;                              ///< its steps are cells, of all observers
  std::vector<std::unique_ptr<Observation>> observations_;  ///< per tile
};

}  // namespace

std::optional<ViewshedWithSurface> compute_by_lattice_sectors(const Store& store, const Request& request,
                                                              std::uint64_t memory, Progress& progress) {
  if (has_raised_features(store, request)) return std::nullopt;
  return LatticeSectors(store, request, memory, progress).run();
}

}  // namespace itin::viewshed
