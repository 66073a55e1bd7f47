#include "caster.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include <itin/parallel.hpp>

namespace itin::viewshed {

/// What is known of a tile's cells so far.
struct Caster::TileWork {
  TileWork(const Grid& units, const RasterGrid& grid, const Tile& t, std::unique_ptr<Observation> o)
      : tile(t), centres(units, grid, t), observation(std::move(o)) {}
  Tile tile;
  TileCentres centres;
  TileValues<double> heights;  ///< of the ground, grid units
  TileValues<double> cover;    ///< of the surface over it, where an eye lies under that
  std::unique_ptr<Observation> observation;
  Occluder occluder;
  Tally tally;
};

Caster::Caster(const Tin& targets, const TriangleBins& bins, const Tin* cover, const Scene& scene,
               const std::vector<Eye>& eyes, const Observations& observations, Result& result)
    : targets_(targets),
      bins_(bins),
      scene_(scene),
      eyes_(eyes),
      observations_(observations),
      result_(result),
      tiles_(grid_of_tiles(result.grid)),
      grazing_(kGrazing / targets.grid.resolution),
      cover_(nullptr),
      covered_(eyes.size()) {
  if (cover != nullptr) find_covered_eyes(*cover);
}

void Caster::find_covered_eyes(const Tin& cover) {
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    const auto height = scene_.ground(eyes_[i].position);
    if (!height || eyes_[i].elevation >= *height - kGrazing) continue;
    covered_[i] = 1;
    cover_ = &cover;
  }
  if (cover_ != nullptr) cover_bins_.emplace(cover, tiles_);
}

void Caster::run(Progress& progress) {
  Observation::prepare(result_);
  const std::size_t count = tiles_.cell_count();
  std::atomic<std::size_t> done = 0;
  std::vector<Tally> tallies(count);
  parallel_for(count, [&](std::size_t i) {
    progress.throw_if_cancelled();
    tallies[i] = decide(i);
    const std::size_t now = ++done;
    if (now % 64 == 0 || now == count)
      progress.report("sight lines", static_cast<double>(now) / static_cast<double>(count));
  });
  for (const Tally& tally : tallies) {
    result_.cells.visible += tally.cells.visible;
    result_.cells.hidden += tally.cells.hidden;
    result_.cells.outside += tally.cells.outside;
    result_.statistics.rays += tally.rays;
    result_.error_bound_m = std::max(result_.error_bound_m, scene_.error_bound(tally.longest));
  }
}

Caster::Tally Caster::decide(std::size_t tile) const {
  const auto work = std::make_unique<TileWork>(targets_.grid, result_.grid, tile_at(result_.grid, tiles_, tile),
                                               observations_.of_tile());
  scan_convert(targets_, bins_.triangles(tile), work->tile, work->centres, work->heights);
  if (cover_ != nullptr) scan_convert(*cover_, cover_bins_->triangles(tile), work->tile, work->centres, work->cover);
  for (const std::uint32_t observer : eyes_near(work->tile)) {
    for (std::int64_t r = 0; r < work->tile.rows; r += kPacketSide)
      for (std::int64_t c = 0; c < work->tile.columns; c += kPacketSide) look(observer, r, c, *work);
  }
  work->observation->store(work->tile, result_, work->tally.cells);
  return work->tally;
}

/// The eyes that reach the tile, the nearest first: they most often settle what is asked of the others.
std::vector<std::uint32_t> Caster::eyes_near(const Tile& tile) const {
  const Point2 nw = result_.grid.centre(tile.column, tile.row);
  const Point2 se = result_.grid.centre(tile.column + tile.columns - 1, tile.row + tile.rows - 1);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < eyes_.size(); ++i) {
    const Point2 p = eyes_[i].position;
    const double dx = p.x - std::clamp(p.x, nw.x, se.x), dy = p.y - std::clamp(p.y, se.y, nw.y);
    if (const double squared = dx * dx + dy * dy; eyes_[i].view.reaches(squared)) order.emplace_back(squared, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> observers;
  for (const auto& [squared, observer] : order) observers.push_back(observer);
  return observers;
}

void Caster::look(std::uint32_t observer, std::int64_t row, std::int64_t column, TileWork& work) const {
  const Eye& eye = eyes_[observer];
  LookPacket packet;
  SightLines& lines = packet.lines;
  lines.start_at(eye.units);
  const double resolution = targets_.grid.resolution, per_metre = 1 / resolution;
  double longest = 0;
  for (unsigned i = 0; i < SightLines::kSize; ++i) {
    const std::int64_t r = row + i / kPacketSide, c = column + i % kPacketSide;
    const auto cell = static_cast<std::size_t>(r * Tile::kSide + c);
    const double ground = work.heights[cell];
    if (std::isnan(ground)) continue;
    const Point2 centre = result_.grid.centre(work.tile.column + c, work.tile.row + r);
    const double target = work.observation->target(eye, ground * resolution);
    Look& look = packet.looks[i];
    look = {cell, observer, centre.x - eye.position.x, centre.y - eye.position.y, target - eye.elevation};
    if (!work.observation->open(look) || !work.observation->in_view(eye, look)) continue;
    work.observation->enter(cell);
    lines.to_x[i] = work.centres.x[static_cast<std::size_t>(c)];
    lines.to_y[i] = work.centres.y[static_cast<std::size_t>(r)];
    lines.to_z[i] = target * per_metre;
    if (lines.to_z[i] < ground - grazing_) continue;  // an elevation below the ground
    if (lines.to_x[i] == eye.units.x && lines.to_y[i] == eye.units.y) {
      work.observation->see(look);
      continue;
    }
    if (covered_[observer] != 0 && lines.to_z[i] < work.cover[cell] - grazing_) continue;
    lines.active |= 1U << i;
    longest = std::max(longest, look.squared_distance() + look.dz * look.dz);
  }
  if (lines.active == 0) return;
  work.tally.longest = std::max(work.tally.longest, std::sqrt(longest));
  work.tally.rays += static_cast<unsigned>(std::popcount(lines.active));
  work.observation->judge(packet, scene_, work.occluder);
}

}  // namespace itin::viewshed
