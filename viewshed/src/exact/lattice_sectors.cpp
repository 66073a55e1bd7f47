#include "exact/lattice_sectors.hpp"

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
#include <itin/precondition.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "bounds/boundary.hpp"
#include "line/hulls.hpp"
#include "plan/memory.hpp"
#include "plan/sight_sectors.hpp"
#include "progress/stopwatch.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "request/void_shadow.hpp"
#include "run/surface_source.hpp"
#include "scene/exact_scene.hpp"
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

class LatticeSectors final : public SurfaceSource {
 public:
  LatticeSectors(const Store& store, const Request& request, std::uint64_t memory, const Progress& progress)
      : store_(store),
        request_(request),
        memory_(memory),
        all_heights_(asks_for_all_heights(request)),
        share_seen_(all_heights_ ? 1 : kFirstShareSeen),
        reading_(progress) {}

  std::vector<Eye> begin(Result& result, CallProgress& call) override {
    std::vector<Eye> eyes = eyes_on_surface(store_, request_, Detail::tolerance(0), result.ground_m, call);
    retrieve_coarse(result, call.step(kCoarseSurface));
    return eyes;
  }

  bool decide(const EyeGroup& group, ViewshedCells& cells) override {
    return observe_from(group.eyes.front(), group.first, cells);
  }

  /// The surface that maps are drawn over.
  std::shared_ptr<RetrievedSurface> coarse() const { return coarse_; }

 private:
  void retrieve_coarse(Result& result, Progress& progress) {
    const Box box = box_of_window(store_, request_);
    const int level = finest_level_of(store_, box, kCoarsePoints);
    Tin& coarse = coarse_->tin;
    coarse =
        triangulate(store_, window_of(request_), detail_of(store_.metadata(), level), progress, ThemeChoice::none());
    result.grid = cells_of(request_, extent_of(store_));
    tiles_ = grid_of_tiles(result.grid);
    find_voids(coarse.grid, rim_of(coarse, boundary_edges(coarse)), result);
    posts_per_square_metre_ = points_per_square_metre(store_, 0, request_);
    tile_side_m_ = LatticeTin::kSide / std::sqrt(posts_per_square_metre_);
    result.statistics.retrieval_seconds += watch_.lap();
  }

  /// Observes all that one eye looks at. Returns false where the surface is no lattice.
  bool observe_from(const Eye& eye, std::uint32_t observer, ViewshedCells& cells) {
    SightSectors sectors(cells.result().grid, eye);
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
          reach = observe_over(*reader, eye, observer, sectors, sector.parts, cells);
          learn(reader->lattice(), std::isinf(reach));
        }
      }
      sectors.remove_decided(sector, reach);
    }
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
                      std::span<const Tile> parts, ViewshedCells& cells) {
    Result& result = cells.result();
    ExactScene surface(reader.lattice(), request_.earth, result.grid, tiles_);
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
    const ExactJudge judge(surface, {eye, std::move(revealed.view), shadow_of(eye, surface.rim(), result)});
    cells.observe({judge, observer}, by_tile(decided, tiles_));
    result.statistics.lines_seconds += watch_.lap();
    return reach;
  }

  const Store& store_;
  const Request& request_;
  std::uint64_t memory_;
  bool all_heights_;
  double share_seen_;       ///< the part of a sector's tiles that is seen, as far as it is known
  SilentProgress reading_;  ///< while a sector is read
  Stopwatch watch_;
  const std::shared_ptr<RetrievedSurface> coarse_ = std::make_shared<RetrievedSurface>();
  RasterGrid tiles_;
  double posts_per_square_metre_ = 0;
  double tile_side_m_ = 0;   ///< the side of the lattice's tiles, as far as it is known
  bool is_lattice_ = false;  ///< as far as has been read
};

}  // namespace

std::optional<ViewshedWithSurface> compute_by_lattice_sectors(const Store& store, const Request& request,
                                                              std::uint64_t memory, const CellSink& sink,
                                                              Progress& progress) {
  ITIN_PRECONDITION(takes_a_lattice(store, request));
  if (has_raised_features(store, request)) return std::nullopt;
  LatticeSectors source(store, request, memory, progress);
  std::optional<Result> result = run(source, request, sink, progress);
  if (!result) return std::nullopt;
  return ViewshedWithSurface{source.coarse(), std::nullopt, false, std::move(*result)};
}

}  // namespace itin::viewshed
