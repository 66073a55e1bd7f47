#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

#include <itin/parallel.hpp>
#include <viewshed/certified.hpp>

#include "../exact_walk.hpp"
#include "cell_blocks.hpp"
#include "group_survey.hpp"

namespace itin::viewshed {

namespace {

constexpr std::int64_t kBlocks = Tile::kSide / CellBlocks::kSide;  ///< a side of a tile
static_assert(Tile::kSide % CellBlocks::kSide == 0);

using TileWords = std::array<std::uint64_t, kBlocks * kBlocks>;

/// What one option serves of one tile.
struct TileCover {
  std::size_t entry = 0;  ///< of the options
  TileWords certain{}, possible{};
};

std::uint32_t block_of(const CellBlocks& blocks, const Tile& tile, std::size_t i) {
  const auto n = static_cast<std::int64_t>(i);
  return blocks.block({tile.column + n % kBlocks * CellBlocks::kSide, tile.row + n / kBlocks * CellBlocks::kSide});
}

std::size_t blocks_in(const Tile& tile, std::size_t i) {  // whether the grid reaches there
  const auto n = static_cast<std::int64_t>(i);
  return n % kBlocks * CellBlocks::kSide < tile.columns && n / kBlocks * CellBlocks::kSide < tile.rows ? 1 : 0;
}

std::uint64_t members(const DemandSet& set, std::uint32_t number) {
  const auto& blocks = set.blocks();
  const auto block = std::lower_bound(blocks.begin(), blocks.end(), number,
                                      [](const DemandSet::Block& b, std::uint32_t n) { return b.number < n; });
  return block != blocks.end() && block->number == number ? block->members : 0;
}

std::size_t cell_in_tile(std::size_t block, unsigned bit) {
  const std::size_t row = block / kBlocks * CellBlocks::kSide + bit / CellBlocks::kSide;
  const std::size_t column = block % kBlocks * CellBlocks::kSide + bit % CellBlocks::kSide;
  return row * Tile::kSide + column;
}

/// Opens in `values` what the bounds leave open. Returns whether anything is.
bool open(const CellBlocks& blocks, const Tile& tile, const CoverageBounds& bounds, TileCover& set,
          TileValues<std::uint8_t>& values) {
  bool any = false;
  values.fill(kOutside);
  for (std::size_t b = 0; b < set.certain.size(); ++b) {
    if (blocks_in(tile, b) == 0) continue;
    const std::uint32_t number = block_of(blocks, tile, b);
    set.possible[b] = members(bounds.possible, number);
    if (set.possible[b] == 0) continue;
    set.certain[b] = members(bounds.certain, number);
    for (std::uint64_t rest = set.possible[b] & ~set.certain[b]; rest != 0; rest &= rest - 1) {
      values[cell_in_tile(b, static_cast<unsigned>(std::countr_zero(rest)))] = kUndecided;
      any = true;
    }
  }
  return any;
}

/// Four by four cells and their Fresnel zones.
class ZonePacket {
 public:
  ZonePacket(const SiteScene& scene, const Eye& eye, const CertifiedPass::TileWork& work)
      : scene_(scene), eye_(eye), work_(work) {
    for (SightLines* const lines : {&low_, &high_}) lines->start_at(eye.units);
  }

  /// Of the cells that are visible or may be, leaves what the zones leave.
  void judge(std::size_t row, std::size_t column, TileValues<std::uint8_t>& values) {
    unsigned visible = 0;
    low_.active = high_.active = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const std::size_t r = row + i / kPacketSide, c = column + i % kPacketSide, cell = r * Tile::kSide + c;
      if (values[cell] != kCertainlyVisible && values[cell] != kUndecided) continue;
      aim(i, r, c);
      if (values[cell] == kCertainlyVisible) visible |= 1U << i;
    }
    if (high_.active == 0) return;
    const unsigned cut = scene_.zone->certainly_cut(high_);
    low_.active = scene_.surface.exact ? 0 : high_.active & visible & ~cut;
    const unsigned open = low_.active == 0 ? 0 : low_.active & ~scene_.zone->certainly_clear(low_);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      std::uint8_t& value = values[(row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide];
      if ((cut >> i & 1) != 0) value = kCertainlyHidden;
      if ((open >> i & 1) != 0) value = kUndecided;
    }
  }

 private:
  /// A target at the eye's own place has no zone.
  void aim(unsigned i, std::size_t r, std::size_t c) {
    const double resolution = scene_.surface.envelope.lower.grid.resolution;
    const double x = work_.centres.x[c], y = work_.centres.y[r];
    if (x == eye_.units.x && y == eye_.units.y) return;
    const std::size_t cell = r * Tile::kSide + c;
    low_.to_x[i] = high_.to_x[i] = x;
    low_.to_y[i] = high_.to_y[i] = y;
    low_.to_z[i] = eye_.target(work_.low[cell] * resolution) / resolution;
    high_.to_z[i] = scene_.surface.exact ? low_.to_z[i] : eye_.target(work_.high[cell] * resolution) / resolution;
    high_.active |= 1U << i;
  }

  const SiteScene& scene_;
  const Eye& eye_;
  const CertifiedPass::TileWork& work_;
  SightLines low_, high_;  ///< to the lowest and the highest targets
};

void judge_zones(const SiteScene& scene, const EnvelopeScene::Look& look, const CertifiedPass::TileWork& work,
                 TileValues<std::uint8_t>& values) {
  ZonePacket packet(scene, look.eye, work);
  for (std::size_t row = 0; row < Tile::kSide; row += kPacketSide)
    for (std::size_t column = 0; column < Tile::kSide; column += kPacketSide) packet.judge(row, column, values);
}

void close(const TileValues<std::uint8_t>& values, TileCover& set) {
  for (std::size_t b = 0; b < set.certain.size(); ++b) {
    for (std::uint64_t rest = set.possible[b] & ~set.certain[b]; rest != 0; rest &= rest - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(rest));
      const std::uint8_t value = values[cell_in_tile(b, bit)];
      if (value == kCertainlyVisible) set.certain[b] |= std::uint64_t{1} << bit;
      if (value == kCertainlyHidden || value == kOutside) set.possible[b] &= ~(std::uint64_t{1} << bit);
    }
  }
}

DemandSet gather(std::vector<DemandSet::Block>& blocks) {
  std::sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  DemandSet set;
  for (const DemandSet::Block& block : blocks) set.add(block.number, block.members);
  return set;
}

bool in_reach(const RasterGrid& tiles, std::size_t tile, Point2 p, double radius) {
  const auto column = static_cast<std::int64_t>(tile) % tiles.columns(),
             row = static_cast<std::int64_t>(tile) / tiles.columns();
  const Point2 c = tiles.centre(column, row);
  const double dx = std::max(0.0, std::abs(p.x - c.x) - tiles.cell_width() / 2);
  const double dy = std::max(0.0, std::abs(p.y - c.y) - tiles.cell_height() / 2);
  return dx * dx + dy * dy <= radius * radius;
}

}  // namespace

std::vector<CoverageBounds> judge_cells(const SiteScene& site_scene, const SiteSurvey& survey, const Request& request,
                                        std::span<const std::size_t> options,
                                        std::span<const CoverageBounds* const> bounds, Progress& progress,
                                        Statistics& statistics) {
  const EnvelopeScene& scene = site_scene.surface;
  const RasterGrid& grid = *survey.targets.grid;
  const CellBlocks blocks(grid);
  const RasterGrid tiles = grid_of_tiles(grid);
  const CertifiedPass pass(scene, grid, tiles);
  std::vector<std::optional<EnvelopeScene::Look>> looks(options.size());
  parallel_for(options.size(), [&](std::size_t i) {
    const Eye eye = eye_at(scene.envelope.lower.grid, request, survey.stands[options[i]]);
    const auto tile = tiles.cell_at(eye.position);
    looks[i] = tile ? scene.look_from(eye, scene.bins.triangles(tiles.index(*tile))) : scene.look_from(eye);
  });
  std::vector<std::vector<TileCover>> of_tile(tiles.cell_count());
  std::atomic<std::uint64_t> rays = 0;
  std::atomic<std::size_t> done = 0;
  parallel_for(of_tile.size(), [&](std::size_t t) {
    progress.throw_if_cancelled();
    std::unique_ptr<CertifiedPass::TileWork> work;
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (!in_reach(tiles, t, survey.stands[options[i]].position, survey.radius)) continue;
      if (!work) work = pass.begin(t);
      TileCover set{.entry = i};
      TileValues<std::uint8_t> values;
      if (open(blocks, work->tile, *bounds[i], set, values)) {
        if (scene.exact) {
          pass.judge(*looks[i], values, *work, [&](const Doubtful& d) { walk(scene, d, values); });
        } else {
          pass.judge(*looks[i], values, *work, nullptr);
        }
        if (site_scene.zone) judge_zones(site_scene, *looks[i], *work, values);
        close(values, set);
      }
      if (std::any_of(set.possible.begin(), set.possible.end(), [](std::uint64_t w) { return w != 0; }))
        of_tile[t].push_back(set);
    }
    if (work) rays += work->rays;
    const std::size_t now = ++done;
    if (now % 16 == 0 || now == of_tile.size())
      progress.report("sight lines of candidates", static_cast<double>(now) / static_cast<double>(of_tile.size()));
  });
  statistics.rays += rays;

  std::vector<std::vector<DemandSet::Block>> certain(options.size()), possible(options.size());
  for (std::size_t t = 0; t < of_tile.size(); ++t) {
    const Tile tile = tile_at(grid, tiles, t);
    for (const TileCover& set : of_tile[t]) {
      for (std::size_t b = 0; b < set.possible.size(); ++b) {
        if (set.possible[b] == 0) continue;
        const std::uint32_t number = block_of(blocks, tile, b);
        possible[set.entry].push_back({number, set.possible[b]});
        if (set.certain[b] != 0) certain[set.entry].push_back({number, set.certain[b]});
      }
    }
  }
  std::vector<CoverageBounds> result(options.size());
  parallel_for(result.size(), [&](std::size_t i) {
    result[i] = {.certain = gather(certain[i]), .possible = gather(possible[i]), .exact = scene.exact};
  });
  return result;
}

}  // namespace itin::viewshed
