#include <algorithm>
#include <atomic>
#include <cmath>

#include <itin/lattice_reader.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/certified.hpp>

#include "certified_pass.hpp"
#include "near_ground.hpp"
#include "request.hpp"
#include "stopwatch.hpp"

namespace itin::viewshed {

namespace {

/// Every observer's verdict on a cell, made one.
class Verdicts {
 public:
  Verdicts() { values.fill(kOutside); }

  void add(const TileValues<std::uint8_t>& of_observer) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::uint8_t v = of_observer[i];
      if (v == kOutside || values[i] == kCertainlyVisible) continue;
      if (values[i] == kOutside || v == kCertainlyVisible) {
        values[i] = v;
      } else if (v == kUndecided) {
        values[i] = kUndecided;
      }
    }
  }

  TileValues<std::uint8_t> values;
};

void count(std::uint8_t value, CellCounts& cells) {
  switch (value) {
    case kCertainlyVisible:
      ++cells.visible;
      break;
    case kCertainlyHidden:
      ++cells.hidden;
      break;
    case kUndecided:
      ++cells.undecided;
      break;
    default:
      ++cells.outside;
  }
}

struct Tally {
  CellCounts cells;
  std::uint64_t rays = 0;
};

Tally decide(const CertifiedPass& pass, std::size_t tile, const std::vector<EnvelopeScene::Look>& looks,
             Result& result) {
  const auto work = pass.begin(tile);
  Verdicts verdicts;
  for (const EnvelopeScene::Look& look : looks) {
    TileValues<std::uint8_t> values;
    // What one observer certainly sees need not be asked of the others.
    std::transform(verdicts.values.begin(), verdicts.values.end(), values.begin(),
                   [](std::uint8_t v) { return v == kCertainlyVisible ? kOutside : kUndecided; });
    pass.judge(look, values, *work, nullptr);
    verdicts.add(values);
  }
  Tally tally;
  tally.rays = work->rays;
  for (std::int64_t r = 0; r < work->tile.rows; ++r) {
    const std::size_t first = result.grid.index({work->tile.column, work->tile.row + r});
    for (std::int64_t c = 0; c < work->tile.columns; ++c) {
      const std::uint8_t value = verdicts.values[static_cast<std::size_t>(r * Tile::kSide + c)];
      result.visible[first + static_cast<std::size_t>(c)] = value;
      count(value, tally.cells);
    }
  }
  return tally;
}

void decide_all(const CertifiedPass& pass, const RasterGrid& tiles, const std::vector<EnvelopeScene::Look>& looks,
                Result& result, Progress& progress) {
  std::vector<Tally> tallies(tiles.cell_count());
  std::atomic<std::size_t> done = 0;
  parallel_for(tallies.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    tallies[i] = decide(pass, i, looks, result);
    const std::size_t now = ++done;
    if (now % 64 == 0 || now == tallies.size())
      progress.report("sight lines", static_cast<double>(now) / static_cast<double>(tallies.size()));
  });
  for (const Tally& tally : tallies) {
    result.cells.visible += tally.cells.visible;
    result.cells.hidden += tally.cells.hidden;
    result.cells.undecided += tally.cells.undecided;
    result.cells.outside += tally.cells.outside;
    result.statistics.rays += tally.rays;
  }
}

Voids voids_of(NoData rule) {
  return rule == NoData::kUnknown ? Voids::kDoubt : voids_without_doubt(rule);
}

/// A point of an envelope costs about as much as two of the full surface, or as so many posts of a lattice.
constexpr std::uint64_t kEnvelopeCosts = 2, kEnvelopeCostsInPosts = 8;
/// So few posts are looked at in a moment, whatever way is asked for.
constexpr std::uint64_t kFewPosts = 100000;
/// More take over a gigabyte, which the full surface, read by segments, does not.
constexpr std::uint64_t kMostEnvelopePoints = 1500000;

/// Whether the level asked for is no cheaper than the full surface: level 0 itself, others that leave out little, and
/// those that are too large for the memory.
bool exact_is_as_cheap(const Store& store, const Request& request) {
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const Box box = box_of_window(store, request);
  const std::uint64_t points = store.points_about(level, box), all = store.points_about(0, box);
  if (points > kMostEnvelopePoints || kEnvelopeCosts * points >= all) return true;
  const std::uint64_t most_posts = PreciseOptions().memory_bytes / kBytesAPost;
  return all > kFewPosts && kEnvelopeCostsInPosts * points >= all && all <= most_posts &&
         LatticeReader::may_open(store, window_of(request), ThemeChoice::none(), most_posts);
}

/// The exact answer, but where ground without data leaves it open.
Surveyed decide_exactly(const Store& store, const Request& request, Progress& progress) {
  Request open = request, closed = request;
  open.mode = closed.mode = Mode::kVisible;
  if (request.nodata == NoData::kUnknown) open.nodata = NoData::kClear, closed.nodata = NoData::kBlock;
  Surveyed surveyed = compute_precise(store, open, {}, progress);
  Result& result = surveyed.result;
  const bool doubtful = request.nodata == NoData::kUnknown && result.crosses_voids;
  const std::vector<std::uint8_t> blocked =
      doubtful ? compute_precise(store, closed, {}, progress).result.visible : result.visible;
  result.request = request;
  result.cells = {};
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    std::uint8_t& value = result.visible[i];
    if (value != kOutside)
      value = value == kHidden ? kCertainlyHidden : blocked[i] == kVisible ? kCertainlyVisible : kUndecided;
    count(value, result.cells);
  }
  return surveyed;
}

}  // namespace

Surveyed compute_certified(const Store& store, const Request& request, Progress& progress) {
  validate(request);
  // Certificates know nothing of features on the ground.
  if (features_stand(store, request) || exact_is_as_cheap(store, request))
    return decide_exactly(store, request, progress);
  Surveyed surveyed;
  Result& result = surveyed.result;
  result.request = request;
  Stopwatch watch;
  const std::vector<Eye> eyes = eyes_on_full_surface(store, request, result.ground_m, progress);
  Envelope envelope = envelop(store, certified_request(store, request), progress);
  result.statistics.retrieval = envelope.lower.statistics;
  result.statistics.triangles = envelope.lower.triangles.size();
  result.statistics.retrieval_seconds = watch.lap();

  progress.report("scene", 0);
  result.grid = cells_of(request, envelope.lower.bounds());
  const RasterGrid tiles = grid_of_tiles(result.grid);
  const EnvelopeScene scene(std::move(envelope), request, tiles, voids_of(request.nodata));
  std::vector<EnvelopeScene::Look> looks;
  for (const Eye& eye : eyes) looks.push_back(scene.look_from(eye));
  result.statistics.scene_seconds = watch.lap();

  result.visible.resize(result.grid.cell_count());
  decide_all(CertifiedPass(scene, result.grid, tiles), tiles, looks, result, progress);
  result.statistics.rays_seconds = watch.lap();
  surveyed.surface.tin = scene.envelope.lower;
  return surveyed;
}

}  // namespace itin::viewshed
