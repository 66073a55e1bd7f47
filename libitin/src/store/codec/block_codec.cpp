#include "store/codec/block_codec.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include <itin/precondition.hpp>

#include "geometry/common_divisor.hpp"
#include "store/codec/bit_stream.hpp"
#include "store/codec/block_header.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/height_predictor.hpp"
#include "store/codec/lattice_heights.hpp"
#include "store/codec/radix_sort.hpp"

namespace itin {

namespace {

// A point with its level.
struct LevelPoint {
  GridPoint point;
  std::uint8_t level = 0;
};

// Joins points and their levels, of which there may be none.
std::vector<LevelPoint> with_levels(std::span<const GridPoint> points, std::span<const std::uint8_t> levels) {
  std::vector<LevelPoint> joined;
  joined.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    joined.push_back({points[i], levels.empty() ? std::uint8_t{0} : levels[i]});
  return joined;
}

// Adapts the Rice parameter of height residuals to their running mean.
class ResidualScale {
 public:
  explicit ResidualScale(int k) : mean_(std::uint64_t{16} << k) {}
  int parameter() const { return std::min<int>(std::bit_width(mean_ >> 5), kMaxRiceParameter); }
  void add(std::uint64_t v) { mean_ += v - (mean_ >> 4); }

 private:
  std::uint64_t mean_;  // times 16
};

// Returns the column and row of a point in the lattice, which has steps of 1 where points are scattered.
LocalPosition place_in(const Cell& cell, const CellLattice& lattice, const GridPoint& p) {
  const GridBox box = cell.box();
  const auto x = static_cast<std::uint64_t>(p.x - box.xmin), y = static_cast<std::uint64_t>(p.y - box.ymin);
  return {static_cast<std::uint32_t>((x - lattice.x0) / lattice.step_x),
          static_cast<std::uint32_t>((y - lattice.y0) / lattice.step_y)};
}

std::uint64_t rank_on(const Cell& cell, const CellLattice& lattice, const GridPoint& p) {
  const LocalPosition place = place_in(cell, lattice, p);
  return place.y * lattice.columns + place.x;
}

void sort_by_rows(const Cell& cell, const CellLattice& lattice, std::vector<LevelPoint>& points) {
  radix_sort(points, std::bit_width(lattice.columns * lattice.rows),
             [&](const LevelPoint& p) { return rank_on(cell, lattice, p.point); });
}

// Returns the rank of each point in the order of coding, less its predecessor's rank, less 1.
std::vector<std::uint64_t> gaps_of(const Cell& cell, const BlockHeader& header, std::span<const LevelPoint> points) {
  std::vector<std::uint64_t> gaps;
  gaps.reserve(points.size());
  std::uint64_t next = 0;
  for (const LevelPoint& p : points) {
    const std::uint64_t rank = header.layout == PointLayout::kScattered ? code_of(p.point) - cell.code
                                                                        : rank_on(cell, header.lattice, p.point);
    gaps.push_back(rank - next);
    next = rank + 1;
  }
  return gaps;
}

std::uint64_t block_bits(std::span<const std::uint64_t> values, int k) {
  std::uint64_t bits = 0;
  for (const std::uint64_t v : values) {
    bits += (v >> k) < kRiceEscape ? (v >> k) + 1 + static_cast<unsigned>(k)
                                   : kRiceEscape + 6 + static_cast<unsigned>(std::bit_width(v));
  }
  return bits;
}

int best_block_parameter(std::span<const std::uint64_t> values) {
  const std::uint64_t sum = std::accumulate(values.begin(), values.end(), std::uint64_t{0});
  const int guess = std::bit_width(sum / values.size());
  int best = std::max(0, guess - 6);
  for (int k = best + 1; k <= std::min(guess + 1, kMaxRiceParameter); ++k) {
    if (block_bits(values, k) < block_bits(values, best)) best = k;
  }
  return std::min(best, kMaxRiceParameter);
}

// Reads positions, counted from the corner of the cell, or of the lattice.
std::vector<LocalPosition> read_positions(BitReader& in, int rice, const Cell& cell, const BlockHeader& header) {
  const bool scattered = header.layout == PointLayout::kScattered;
  const std::uint64_t columns = header.lattice.columns,
                      ranks = scattered ? cell.end() - cell.code : columns * header.lattice.rows;
  std::vector<LocalPosition> positions(header.count);
  std::uint64_t rank = ~std::uint64_t{0}, row = 0, row_start = 0;
  for (LocalPosition& p : positions) {
    const std::uint64_t gap = in.rice(rice);
    if (gap >= ranks || (rank += gap + 1) >= ranks) throw DecodeError("a point lies outside its cell");
    if (scattered) {
      p = {detail_morton::gather(rank), detail_morton::gather(rank >> 1)};
      continue;
    }
    if (rank - row_start >= columns) row = rank / columns, row_start = row * columns;
    p = {static_cast<std::uint32_t>(rank - row_start), static_cast<std::uint32_t>(row)};
  }
  return positions;
}

// Returns heights in steps from the first one, in the order of coding.
std::vector<std::int64_t> heights_of(std::span<const LevelPoint> points, std::uint64_t step) {
  std::vector<std::int64_t> heights;
  heights.reserve(points.size());
  for (const LevelPoint& p : points)
    heights.push_back((std::int64_t{p.point.z} - points[0].point.z) / static_cast<std::int64_t>(step));
  return heights;
}

// Calls visit(i, prediction) for each point but the first; visit returns the height.
template <typename Visit>
void for_each_prediction(std::vector<LocalPosition> positions, const Visit& visit) {
  const std::size_t count = positions.size();
  HeightPredictor predictor(std::move(positions));
  predictor.add(0);
  for (std::size_t i = 1; i < count; ++i) predictor.add(visit(i, predictor.predict()));
}

// Returns the parameter that the residuals' scale starts from: the parameter of their mean.
int mean_parameter(std::span<const std::uint64_t> residuals) {
  if (residuals.empty()) return 0;
  const std::uint64_t sum = std::accumulate(residuals.begin(), residuals.end(), std::uint64_t{0});
  return std::min<int>(std::bit_width(sum / residuals.size()), kMaxRiceParameter);
}

std::uint64_t height_step(std::span<const LevelPoint> points) {
  CommonDivisor step;
  for (const LevelPoint& p : points) step.include(std::int64_t{p.point.z} - points[0].point.z);
  return step.value();
}

void put_levels(BitWriter& bits, std::span<const LevelPoint> points) {
  for (const LevelPoint& p : points) bits.rice(p.level, 0);
}

// Writes what is known of points that are not a full lattice.
void put_points(std::vector<std::uint8_t>& out, const Cell& cell, const BlockHeader& header,
                std::span<const LevelPoint> points) {
  const std::vector<std::uint64_t> gaps = gaps_of(cell, header, points);
  const std::vector<std::int64_t> heights = heights_of(points, header.step_z);
  std::vector<LocalPosition> positions;
  positions.reserve(points.size());
  for (const LevelPoint& p : points) positions.push_back(place_in(cell, header.lattice, p.point));
  std::vector<std::uint64_t> residuals;
  residuals.reserve(heights.size());
  for_each_prediction(std::move(positions), [&](std::size_t i, std::int64_t prediction) {
    residuals.push_back(zigzag(heights[i] - prediction));
    return heights[i];
  });
  const int gap_rice = best_block_parameter(gaps), first_rice = mean_parameter(residuals);
  out.push_back(static_cast<std::uint8_t>(gap_rice));
  out.push_back(static_cast<std::uint8_t>(first_rice));
  BitWriter bits(out);
  for (const std::uint64_t gap : gaps) bits.rice(gap, gap_rice);
  ResidualScale scale(first_rice);
  for (const std::uint64_t r : residuals) {
    bits.rice(r, scale.parameter());
    scale.add(r);
  }
  if (header.coarsest > 0) put_levels(bits, points);
  bits.finish();
}

void put_full_lattice(std::vector<std::uint8_t>& out, const BlockHeader& header, std::span<const LevelPoint> points) {
  put_lattice_heights(out, heights_of(points, header.step_z), header.lattice.columns);
  if (header.coarsest == 0) return;
  BitWriter bits(out);
  put_levels(bits, points);
  bits.finish();
}

}  // namespace

std::vector<std::uint8_t> encode_block(const Cell& cell, std::span<const GridPoint> points,
                                       std::span<const std::uint16_t> sources, std::span<const std::uint8_t> levels) {
  ITIN_PRECONDITION(!points.empty() && points.size() <= kMaxBlockPoints && sources.size() == points.size());
  ITIN_PRECONDITION(levels.empty() || levels.size() == points.size());
  ITIN_PRECONDITION(std::adjacent_find(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) {
                      return code_of(a) >= code_of(b);
                    }) == points.end());
  ITIN_PRECONDITION(cell.contains(code_of(points.front())) && cell.contains(code_of(points.back())));
  BlockHeader header;
  header.count = points.size();
  header.coarsest = levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
  find_layout(cell, points, header);
  std::vector<LevelPoint> ordered = with_levels(points, levels);
  if (header.layout != PointLayout::kScattered) sort_by_rows(cell, header.lattice, ordered);
  header.step_z = height_step(ordered);
  header.first_z = ordered[0].point.z;
  std::vector<std::uint8_t> out;
  put_header(out, header);
  put_sources(out, sources);
  if (header.layout == PointLayout::kFullLattice) {
    put_full_lattice(out, header, ordered);
  } else {
    put_points(out, cell, header, ordered);
  }
  return out;
}

namespace {

// Tells how high a height may be, in steps, for its product with the step to be a 32-bit difference.
std::int64_t most_steps(const BlockHeader& header) {
  return (std::int64_t{1} << 32) / static_cast<std::int64_t>(header.step_z);
}

// Returns a height in grid units. Throws DecodeError where it is none.
std::int32_t height_at(const BlockHeader& header, std::int64_t steps, std::int64_t most) {
  if (steps < -most || steps > most) throw DecodeError("a height is out of range");
  const std::int64_t z = header.first_z + steps * static_cast<std::int64_t>(header.step_z);
  if (z < std::numeric_limits<std::int32_t>::min() || z > std::numeric_limits<std::int32_t>::max())
    throw DecodeError("a height is out of range");
  return static_cast<std::int32_t>(z);
}

// Returns the plan position of each local position, at height 0.
std::vector<GridPoint> plan_points(const Cell& cell, const CellLattice& lattice,
                                   std::span<const LocalPosition> positions) {
  const GridBox box = cell.box();
  std::vector<GridPoint> points;
  points.reserve(positions.size());
  for (const LocalPosition& p : positions) {
    points.push_back({static_cast<std::int32_t>(box.xmin + lattice.x0 + p.x * lattice.step_x),
                      static_cast<std::int32_t>(box.ymin + lattice.y0 + p.y * lattice.step_y), 0});
  }
  return points;
}

// Returns the places of a full lattice, row by row, at height 0.
std::vector<GridPoint> plan_points(const Cell& cell, const CellLattice& lattice) {
  const GridBox box = cell.box();
  std::vector<GridPoint> points;
  points.reserve(lattice.columns * lattice.rows);
  for (std::uint64_t row = 0; row < lattice.rows; ++row) {
    for (std::uint64_t column = 0; column < lattice.columns; ++column)
      points.push_back({static_cast<std::int32_t>(box.xmin + lattice.x0 + column * lattice.step_x),
                        static_cast<std::int32_t>(box.ymin + lattice.y0 + row * lattice.step_y), 0});
  }
  return points;
}

// Bits with the zeros after them that a BitReader needs.
std::vector<std::uint8_t> padded(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> copy;
  copy.reserve(bytes.size() + BitReader::kPadding);
  copy.assign(bytes.begin(), bytes.end());
  copy.resize(copy.size() + BitReader::kPadding);
  return copy;
}

void read_levels(BitReader& bits, const BlockHeader& header, Block& block) {
  if (header.coarsest == 0) return;
  block.levels.resize(header.count);
  for (std::uint8_t& level : block.levels) {
    const std::uint64_t v = bits.rice(0);
    if (v > static_cast<std::uint64_t>(header.coarsest)) throw DecodeError("a level is too coarse");
    level = static_cast<std::uint8_t>(v);
  }
}

void require_end(const BitReader& bits) {
  if (!bits.finished_cleanly()) throw DecodeError("points end too early or too late");
}

std::vector<std::int64_t> read_full_heights(ByteReader& in, const BlockHeader& header) {
  std::vector<std::int64_t> heights(header.count);
  read_lattice_heights(in, heights, header.lattice.columns);
  return heights;
}

void read_full_lattice(ByteReader& in, const Cell& cell, const BlockHeader& header, Block& block) {
  const std::vector<std::int64_t> heights = read_full_heights(in, header);
  block.points = plan_points(cell, header.lattice);
  const std::int64_t most = most_steps(header);
  for (std::size_t i = 0; i < heights.size(); ++i) block.points[i].z = height_at(header, heights[i], most);
  const std::vector<std::uint8_t> bytes = padded(in.rest());
  BitReader bits(bytes);
  read_levels(bits, header, block);
  require_end(bits);
}

void read_points(ByteReader& in, const Cell& cell, const BlockHeader& header, Block& block) {
  const auto gap_rice = static_cast<int>(in.varint(0, kMaxRiceParameter));
  const auto first_rice = static_cast<int>(in.varint(0, kMaxRiceParameter));
  const std::vector<std::uint8_t> bytes = padded(in.rest());
  BitReader bits(bytes);
  std::vector<LocalPosition> positions = read_positions(bits, gap_rice, cell, header);
  block.points = plan_points(cell, header.lattice, positions);
  block.points[0].z = header.first_z;
  const std::int64_t most = most_steps(header);
  ResidualScale scale(first_rice);
  for_each_prediction(std::move(positions), [&](std::size_t i, std::int64_t prediction) {
    const std::uint64_t residual = bits.rice(scale.parameter());
    scale.add(residual);
    const auto height = static_cast<std::int64_t>(static_cast<std::uint64_t>(prediction) +
                                                  static_cast<std::uint64_t>(unzigzag(residual)));
    block.points[i].z = height_at(header, height, most);
    return height;
  });
  read_levels(bits, header, block);
  require_end(bits);
}

/// Leaves out the points of levels below `finest`.
void leave_out_finer(int finest, Block& block) {
  std::size_t kept = 0;
  PointSources sources;
  for (std::size_t i = 0; i < block.levels.size(); ++i) {
    if (block.levels[i] < finest) continue;
    block.points[kept] = block.points[i];
    block.levels[kept] = block.levels[i];
    sources.add(block.sources[i]);
    ++kept;
  }
  block.points.resize(kept);
  block.levels.resize(kept);
  block.sources = std::move(sources);
}

void sort_along_curve(const Cell& cell, const CellLattice& lattice, Block& block) {
  // All codes already differ without the low bits, which the lattice's steps leave free.
  const int low_bits = 2 * (std::bit_width(std::min(lattice.step_x, lattice.step_y)) - 1);
  std::vector<LevelPoint> points = with_levels(block.points, block.levels);
  radix_sort(points, 2 * cell.log2_side - low_bits,
             [&](const LevelPoint& p) { return (code_of(p.point) - cell.code) >> low_bits; });
  for (std::size_t i = 0; i < points.size(); ++i) {
    block.points[i] = points[i].point;
    if (!block.levels.empty()) block.levels[i] = points[i].level;
  }
}

PostLattice post_lattice_of(const Cell& cell, const BlockHeader& header) {
  const GridBox box = cell.box();
  const CellLattice& lattice = header.lattice;
  return {std::int64_t{box.xmin} + lattice.x0, std::int64_t{box.ymin} + lattice.y0,
          static_cast<std::int64_t>(lattice.step_x), static_cast<std::int64_t>(lattice.step_y)};
}

}  // namespace

BlockLattice decode_lattice(const Cell& cell, std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const BlockHeader header = read_header(in, cell);
  return {header.count, post_lattice_of(cell, header)};
}

Block decode_plan(const Cell& cell, std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const BlockHeader header = read_header(in, cell);
  read_sources(in, header.count);
  Block block;
  block.in_order = header.layout == PointLayout::kScattered;
  if (header.layout == PointLayout::kFullLattice) {
    block.points = plan_points(cell, header.lattice);
    return block;
  }
  const auto gap_rice = static_cast<int>(in.varint(0, kMaxRiceParameter));
  in.varint(0, kMaxRiceParameter);
  const std::vector<std::uint8_t> rest = padded(in.rest());
  BitReader bits(rest);
  block.points = plan_points(cell, header.lattice, read_positions(bits, gap_rice, cell, header));
  return block;
}

std::optional<PostHeights> decode_posts(const Cell& cell, std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const BlockHeader header = read_header(in, cell);
  if (header.layout != PointLayout::kFullLattice) return std::nullopt;
  read_sources(in, header.count);
  const std::vector<std::int64_t> heights = read_full_heights(in, header);
  PostHeights posts{post_lattice_of(cell, header), static_cast<std::uint32_t>(header.lattice.columns),
                    static_cast<std::uint32_t>(header.lattice.rows), std::vector<std::int32_t>(heights.size())};
  const std::int64_t most = most_steps(header);
  for (std::size_t i = 0; i < heights.size(); ++i) posts.heights[i] = height_at(header, heights[i], most);
  return posts;
}

Block decode_block(const Cell& cell, std::span<const std::uint8_t> bytes, BlockOrder order, int finest) {
  ByteReader in(bytes);
  const BlockHeader header = read_header(in, cell);
  Block block;
  block.sources = read_sources(in, header.count);
  if (header.layout == PointLayout::kFullLattice) {
    read_full_lattice(in, cell, header, block);
  } else {
    read_points(in, cell, header, block);
  }
  block.in_order = header.layout == PointLayout::kScattered;
  // Sources are in curve order. Where all are the same, the points that are left out need not be sorted.
  const bool early = finest > 0 && block.sources.are_one();
  if (early) leave_out_finer(finest, block);
  if (!block.in_order && (order == BlockOrder::kMorton || (finest > 0 && !early))) {
    sort_along_curve(cell, header.lattice, block);
    block.in_order = true;
  }
  if (finest > 0 && !early) leave_out_finer(finest, block);
  return block;
}

}  // namespace itin
