#include "siting/coverage/judge_tiles.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include <itin/parallel.hpp>
#include <viewshed/result.hpp>

#include "judge/zone_cut.hpp"
#include "line/set_bits.hpp"
#include "progress/stage.hpp"
#include "siting/coverage/demand_blocks.hpp"

namespace itin::viewshed {

namespace {

constexpr std::int64_t kBlocks = Tile::kSide / DemandBlocks::kSide;  ///< blocks per side of a tile
static_assert(Tile::kSide % DemandBlocks::kSide == 0);

using TileWords = std::array<std::uint64_t, kBlocks * kBlocks>;

/// The part of one tile that one option serves.
struct TileCover {
  std::size_t entry = 0;  ///< the option's index among those that are judged
  TileWords certain{}, possible{};

  bool any() const {
    return std::any_of(possible.begin(), possible.end(), [](std::uint64_t w) { return w != 0; });
  }
};

std::uint32_t block_of(const DemandBlocks& blocks, const Tile& tile, std::size_t i) {
  const auto n = static_cast<std::int64_t>(i);
  return blocks.block({tile.column + n % kBlocks * DemandBlocks::kSide, tile.row + n / kBlocks * DemandBlocks::kSide});
}

/// Tells whether the grid reaches block `i` of the tile.
bool in_grid(const Tile& tile, std::size_t i) {
  const auto n = static_cast<std::int64_t>(i);
  return n % kBlocks * DemandBlocks::kSide < tile.columns && n / kBlocks * DemandBlocks::kSide < tile.rows;
}

std::uint64_t members(const DemandSet& set, std::uint32_t number) {
  const auto& blocks = set.blocks();
  const auto block = std::lower_bound(blocks.begin(), blocks.end(), number,
                                      [](const DemandSet::Block& b, std::uint32_t n) { return b.number < n; });
  return block != blocks.end() && block->number == number ? block->members : 0;
}

std::size_t cell_in_tile(std::size_t block, unsigned bit) {
  const std::size_t row = block / kBlocks * DemandBlocks::kSide + bit / DemandBlocks::kSide;
  const std::size_t column = block % kBlocks * DemandBlocks::kSide + bit % DemandBlocks::kSide;
  return row * Tile::kSide + column;
}

/// Sets the cells that the bounds leave open to kUndecided in `values`, which are all kOutside before. Returns whether
/// there are any.
bool open(const DemandBlocks& blocks, const Tile& tile, const CoverageBounds& bounds, TileCover& cover,
          TileValues<Verdict>& values) {
  bool any = false;
  for (std::size_t b = 0; b < cover.certain.size(); ++b) {
    if (!in_grid(tile, b)) continue;
    const std::uint32_t number = block_of(blocks, tile, b);
    cover.possible[b] = members(bounds.possible, number);
    if (cover.possible[b] == 0) continue;
    cover.certain[b] = members(bounds.certain, number);
    for_each_bit(cover.possible[b] & ~cover.certain[b], [&](unsigned bit) {
      values[cell_in_tile(b, bit)] = Verdict::kUndecided;
      any = true;
    });
  }
  return any;
}

void close(const TileValues<Verdict>& values, TileCover& cover) {
  for (std::size_t b = 0; b < cover.certain.size(); ++b) {
    for_each_bit(cover.possible[b] & ~cover.certain[b], [&](unsigned bit) {
      const Verdict value = values[cell_in_tile(b, bit)];
      if (value == Verdict::kVisible) cover.certain[b] |= std::uint64_t{1} << bit;
      if (value == Verdict::kHidden || value == Verdict::kZoneCut || value == Verdict::kOutside)
        cover.possible[b] &= ~(std::uint64_t{1} << bit);
    });
  }
}

DemandSet set_of(std::vector<DemandSet::Block>& blocks) {
  std::sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  DemandSet set;
  for (const DemandSet::Block& block : blocks) set.add(block.number, block.members);
  return set;
}

/// Finds tile by tile what every site serves.
class SiteTiles {
 public:
  SiteTiles(const TileJudge& judge, const std::optional<ClearZone>& zone, const SiteSurvey& survey,
            const SitesToJudge& sites)
      : judge_(judge),
        zone_(zone),
        survey_(survey),
        sites_(sites),
        grid_(*survey.targets.grid),
        tiles_(grid_of_tiles(grid_)),
        blocks_(grid_),
        covers_(tiles_.cell_count()) {}

  std::vector<CoverageBounds> run(Progress& progress, Statistics& statistics) {
    std::atomic<std::uint64_t> lines = 0;
    for_each_step(covers_.size(), "sight lines of candidates", progress,
                  [&](std::size_t t) { lines += judge(t, progress); });
    statistics.lines += lines;
    return gather();
  }

 private:
  /// Judges tile `t`. Returns the number of sight lines that were cast.
  std::uint64_t judge(std::size_t t, const Progress& progress) {
    const Tile tile = tile_at(grid_, tiles_, t);
    const Box box = box_of(grid_, tile);
    std::vector<TileCover>& covers = covers_[t];
    const auto open_some = [&](std::size_t i, TileValues<Verdict>& values) {
      const Point2 position = survey_.positions[sites_.options[i]].position;
      if (squared_distance(position, box) > survey_.radius * survey_.radius) return false;
      TileCover cover{.entry = i};
      const bool any = open(blocks_, tile, *sites_.bounds[i], cover, values);
      if (cover.any()) covers.push_back(cover);
      return any;
    };
    const auto close_them = [&](std::size_t i, TileValues<Verdict>& values, TileJudge::Work& work) {
      if (zone_) cut_zones(*zone_, judge_.eye(i), work.targets(), progress, values);
      close(values, covers.back());
      if (!covers.back().any()) covers.pop_back();
    };
    return judge_tile(judge_, t, sites_.options.size(), open_some, close_them);
  }

  std::vector<CoverageBounds> gather() const {
    const std::size_t options = sites_.options.size();
    std::vector<std::vector<DemandSet::Block>> certain(options), possible(options);
    for (std::size_t t = 0; t < covers_.size(); ++t) {
      const Tile tile = tile_at(grid_, tiles_, t);
      for (const TileCover& cover : covers_[t]) {
        for (std::size_t b = 0; b < cover.possible.size(); ++b) {
          if (cover.possible[b] == 0) continue;
          const std::uint32_t number = block_of(blocks_, tile, b);
          possible[cover.entry].push_back({number, cover.possible[b]});
          if (cover.certain[b] != 0) certain[cover.entry].push_back({number, cover.certain[b]});
        }
      }
    }
    std::vector<CoverageBounds> result(options);
    parallel_for(options, [&](std::size_t i) {
      result[i].certain = set_of(certain[i]);
      result[i].possible = set_of(possible[i]);
    });
    return result;
  }

  const TileJudge& judge_;
  const std::optional<ClearZone>& zone_;
  const SiteSurvey& survey_;
  const SitesToJudge& sites_;
  const RasterGrid& grid_;
  const RasterGrid tiles_;
  const DemandBlocks blocks_;
  std::vector<std::vector<TileCover>> covers_;  ///< one list per tile
};

}  // namespace

std::vector<CoverageBounds> judge_tiles(const TileJudge& judge, const std::optional<ClearZone>& zone,
                                        const SiteSurvey& survey, const SitesToJudge& sites, Progress& progress,
                                        Statistics& statistics) {
  return SiteTiles(judge, zone, survey, sites).run(progress, statistics);
}

}  // namespace itin::viewshed
