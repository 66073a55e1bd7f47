#include "huge_store/fractal_store.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "gdal/crs.hpp"
#include "huge_store/deviation.hpp"
#include "huge_store/fractal.hpp"
#include "huge_store/fractal_levels.hpp"
#include "huge_store/square.hpp"
#include "import/source/source_context.hpp"
#include "store/codec/radix_sort.hpp"
#include "store/store_writer.hpp"

namespace itin::huge {

namespace {

/// Posts of a tile, which one thread makes: their heights fit into its cache.
constexpr std::int64_t kTilePosts = 1 << 17;
/// Tiles in memory at a time, and as many that are being written.
constexpr std::size_t kTilesAtOnce = 128;

/// Stages from this one on have few enough posts to be stored a second time.
constexpr int kFirstCopiedStage = 2;

using Leaves = std::vector<EncodedLeaf>;

/// A post and its coarsest level.
struct Post {
  GridPoint point;
  std::uint8_t level = 0;
};

/// Returns the first level that is stored a second time.
int fine_levels(const std::vector<FractalLevel>& levels) {
  std::size_t level = 1;
  while (level < levels.size() && levels[level].stage < kFirstCopiedStage) ++level;
  return static_cast<int>(level);
}

class FractalWriter {
 public:
  FractalWriter(StoreWriter& writer, const Square& square, const Fractal& fractal,
                const std::vector<FractalLevel>& levels)
      : writer_(writer),
        square_(square),
        fractal_(fractal),
        levels_(levels),
        fine_levels_(fine_levels(levels)),
        deviation_(square, fractal, levels) {
    writer_.set_fine_levels(fine_levels_);
  }

  /// Writes the ground, and then a level after the other.
  void write_level(int number, Progress& progress) {
    const FractalLevel& level = level_at(number);
    std::vector<Cell> tiles;
    for_each_leaf(level, square_, Cell{}, kTilePosts, [&](const Cell& cell) { tiles.push_back(cell); });
    const std::string stage = fmt::format("writing level {}", number);
    std::vector<Leaves> ready, next;
    for (std::size_t first = 0; first < tiles.size(); first += kTilesAtOnce) {
      progress.throw_if_cancelled();
      progress.report(stage, static_cast<double>(first) / static_cast<double>(tiles.size()));
      next.assign(std::min(kTilesAtOnce, tiles.size() - first), {});
      // One thread writes while the others encode what comes next.
      parallel_for(next.size() + 1, [&](std::size_t i) {
        if (i == 0) {
          write(ready);
        } else {
          next[i - 1] = make(number, level, tiles[first + i - 1]);
        }
      });
      ready.swap(next);
    }
    write(ready);
  }

  const FractalStoreReport& report() const { return report_; }

 private:
  Leaves make(int number, const FractalLevel& level, const Cell& tile) {
    const Posts heights = fractal_.heights(level.stage, square_.about(tile, level.stage));
    // The full surface comes first.
    if (number == 0) deviation_.find(tile, heights);
    Leaves leaves;
    for_each_leaf(level, square_, tile, number == 0 ? kGroundCapacity : kLeafCapacity,
                  [&](const Cell& cell) { leaves.push_back(encoded(number, level, cell, heights)); });
    return leaves;
  }

  /// The ground has all posts of the finest stage.
  const FractalLevel& level_at(int number) const {
    static constexpr FractalLevel kGround{};
    return number == 0 ? kGround : levels_[static_cast<std::size_t>(number)];
  }

  /// Returns the coarsest level that has a post of the finest stage.
  std::uint8_t level_of(std::int32_t column, std::int32_t row) const {
    std::size_t level = 0;
    while (level + 1 < levels_.size() && ((column | row) & ((1 << levels_[level + 1].stage) - 1)) == 0) ++level;
    return static_cast<std::uint8_t>(level);
  }

  EncodedLeaf encoded(int number, const FractalLevel& level, const Cell& cell, const Posts& heights) const {
    const PostBox box = square_.within(cell, level.stage);
    std::vector<Post> posts;
    posts.reserve(kGroundCapacity);
    for (std::int32_t row = box.rows.first; row <= box.rows.last; ++row) {
      for (std::int32_t column = box.columns.first; column <= box.columns.last; ++column) {
        if (level.keeps(column, row))
          posts.push_back({square_.post(level.stage, column, row, *heights.at(column, row)), level_of(column, row)});
      }
    }
    radix_sort(posts, 2 * cell.log2_side, [&](const Post& p) { return code_of(p.point) - cell.code; });
    std::vector<GridPoint> points;
    std::vector<std::uint8_t> of_posts;
    for (const Post& p : posts) points.push_back(p.point), of_posts.push_back(p.level);
    const std::vector<std::uint16_t> sources(points.size(), 0);
    if (number == 0) return encode_ground(cell, points, sources, of_posts);
    const HeightBounds bounds = deviation_.over(cell, number);
    return number < fine_levels_ ? bare_leaf(number, cell, points, bounds.lo, bounds.hi)
                                 : encode_leaf(number, cell, points, sources, bounds.lo, bounds.hi);
  }

  void write(const std::vector<Leaves>& tiles) {
    for (const Leaves& leaves : tiles) {
      for (const EncodedLeaf& encoded : leaves) {
        if (encoded.leaf.level > 0) {
          writer_.add_leaf(encoded);
          continue;
        }
        writer_.add_ground(encoded);
        if (encoded.leaf.points == 0) continue;
        report_.posts += encoded.leaf.points;
        report_.lowest = std::min(report_.lowest, encoded.leaf.zmin * Square::kGrid.resolution);
        report_.highest = std::max(report_.highest, encoded.leaf.zmax * Square::kGrid.resolution);
      }
    }
  }

  StoreWriter& writer_;
  const Square& square_;
  const Fractal& fractal_;
  const std::vector<FractalLevel>& levels_;
  int fine_levels_;
  Deviation deviation_;
  FractalStoreReport report_{0, 0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

/// Ground to the left.
std::vector<Segment> outline(const GridBox& b) {
  return {{b.xmin, b.ymin, b.xmax, b.ymin},
          {b.xmax, b.ymin, b.xmax, b.ymax},
          {b.xmax, b.ymax, b.xmin, b.ymax},
          {b.xmin, b.ymax, b.xmin, b.ymin}};
}

SourceInfo source_info(const FractalStoreOptions& options, std::uint64_t posts) {
  constexpr double spacing = Square::kSpacing * Square::kGrid.resolution, gap = 1.5 * spacing;
  SourceInfo source;
  source.path = fmt::format("fractal, seed {}", options.seed);
  source.kind = "terrain";
  source.imported = utc_now();
  source.source_crs = Square::kCrs;
  source.vertices = posts;
  source.gap_basis = {gap, 0, 0, -gap};
  source.spacing = spacing;
  return source;
}

std::int32_t side_of(double side_km, int stage) {
  constexpr double greatest_km = 100;
  if (!(side_km > 0 && side_km <= greatest_km))
    throw InputError(fmt::format("side of {} km: give more than 0, at most {}", side_km, greatest_km));
  const double spacing_m = std::exp2(stage);
  return static_cast<std::int32_t>(std::ceil(side_km * 1000 / spacing_m) * spacing_m);
}

}  // namespace

FractalStoreReport write_fractal_store(const std::string& path, const FractalStoreOptions& options,
                                       Progress& progress) {
  const std::vector<FractalLevel> levels = levels_of(options.tolerances);
  std::vector<double> tolerances;
  for (const FractalLevel& level : levels) tolerances.push_back(level.tolerance);
  const std::int32_t side_m = side_of(options.side_km, levels.back().stage);
  const Square square(side_m);
  const Fractal fractal(options.seed);
  StoreWriter writer(path, parse_crs(Square::kCrs, Square::kCrs).wkt, Square::kGrid, tolerances);
  FractalWriter fractal_writer(writer, square, fractal, levels);
  for (std::size_t k = 0; k < levels.size(); ++k) fractal_writer.write_level(static_cast<int>(k), progress);
  writer.add_segments(outline(square.ground()));
  FractalStoreReport report = fractal_writer.report();
  report.side_m = side_m;
  writer.commit({source_info(options, report.posts)});
  return report;
}

}  // namespace itin::huge
