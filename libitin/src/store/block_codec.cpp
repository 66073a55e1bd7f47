#include "store/block_codec.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <itin/precondition.hpp>

#include "store/bit_stream.hpp"
#include "store/byte_stream.hpp"
#include "store/height_predictor.hpp"
#include "store/lattice_sort.hpp"
#include "store/radix_sort.hpp"

namespace itin {

namespace {

// The lattice that all positions lie on: x = x0 + i * step_x with i < width. Steps of 1 mean that there is no lattice.
// Then positions are coded along the Morton curve, otherwise row by row.
struct Lattice {
  std::uint64_t step_x = 1, step_y = 1;
  std::uint32_t x0 = 0, y0 = 0;  // from the cell's corner
  std::uint64_t width = 1;

  bool scattered() const { return step_x == 1 && step_y == 1; }
};

// Adapts the Rice parameter of height residuals to their running mean.
class ResidualScale {
 public:
  explicit ResidualScale(int k) : mean_(std::uint64_t{16} << k) {}
  int parameter() const { return std::min<int>(std::bit_width(mean_ >> 5), kMaxRiceParameter); }
  void add(std::uint64_t v) { mean_ += v - (mean_ >> 4); }

 private:
  std::uint64_t mean_;  // times 16
};

/// Extends the greatest common divisor of all differences so far to one more. Most differences are multiples of it
/// already.
void include(std::uint64_t& divisor, std::int64_t difference) {
  const auto d = static_cast<std::uint64_t>(std::abs(difference));
  if (divisor == 0 || d % divisor != 0) divisor = std::gcd(divisor, d);
}

Lattice find_lattice(const Cell& cell, std::span<const GridPoint> points) {
  const GridBox box = cell.box();
  GridBox extent;
  Lattice lattice{0, 0, 0, 0, 1};
  for (const GridPoint& p : points) {
    include(lattice.step_x, p.x - points[0].x);
    include(lattice.step_y, p.y - points[0].y);
    extent.extend(p.x, p.y);
  }
  lattice.step_x = std::max<std::uint64_t>(lattice.step_x, 1);
  lattice.step_y = std::max<std::uint64_t>(lattice.step_y, 1);
  if (lattice.scattered()) return {};
  lattice.x0 = static_cast<std::uint32_t>(extent.xmin - box.xmin);
  lattice.y0 = static_cast<std::uint32_t>(extent.ymin - box.ymin);
  lattice.width = static_cast<std::uint64_t>(extent.xmax - extent.xmin) / lattice.step_x + 1;
  return lattice;
}

std::uint64_t rank_on(const Cell& cell, const Lattice& lattice, const GridPoint& p) {
  const GridBox box = cell.box();
  const auto x = static_cast<std::uint64_t>(p.x - box.xmin), y = static_cast<std::uint64_t>(p.y - box.ymin);
  return (y - lattice.y0) / lattice.step_y * lattice.width + (x - lattice.x0) / lattice.step_x;
}

void sort_by_rows(const Cell& cell, const Lattice& lattice, std::vector<GridPoint>& points) {
  const auto highest =
      std::max_element(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) { return a.y < b.y; });
  radix_sort(points, std::bit_width(rank_on(cell, lattice, *highest) + lattice.width),
             [&](const GridPoint& p) { return rank_on(cell, lattice, p); });
}

// Returns the rank of each point in the order of coding, less its predecessor's rank, less 1.
std::vector<std::uint64_t> gaps_of(const Cell& cell, const Lattice& lattice, std::span<const GridPoint> points) {
  std::vector<std::uint64_t> gaps;
  gaps.reserve(points.size());
  std::uint64_t next = 0;
  for (const GridPoint& p : points) {
    const std::uint64_t rank = lattice.scattered() ? code_of(p) - cell.code : rank_on(cell, lattice, p);
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

void put_sources(std::vector<std::uint8_t>& out, std::span<const std::uint16_t> sources) {
  for (std::size_t i = 0; i < sources.size();) {
    std::size_t end = i;
    while (end < sources.size() && sources[end] == sources[i]) ++end;
    const bool more = end < sources.size();
    put_varint(out, std::uint64_t{sources[i]} << 1 | (more ? 1 : 0));
    if (more) put_varint(out, end - i - 1);
    i = end;
  }
}

PointSources read_sources(ByteReader& in, std::size_t count) {
  PointSources sources;
  while (sources.size() < count) {
    const std::uint64_t v = in.varint(0, 0x1ffff);
    const std::size_t left = count - sources.size();
    if ((v & 1) && left < 2) throw DecodeError("more sources than points");
    const std::size_t run = (v & 1) ? in.varint(0, left - 2) + 1 : left;
    sources.add(static_cast<std::uint16_t>(v >> 1), run);
  }
  return sources;
}

// Reads positions, counted from the corner of the cell, or of the lattice.
std::vector<LocalPosition> read_positions(BitReader& in, std::size_t count, int rice, const Cell& cell,
                                          const Lattice& lattice) {
  const std::uint64_t ranks = lattice.scattered() ? cell.end() - cell.code : lattice.width << (cell.log2_side + 1);
  std::vector<LocalPosition> positions(count);
  std::uint64_t rank = ~std::uint64_t{0}, row = 0, row_start = 0;
  for (LocalPosition& p : positions) {
    const std::uint64_t gap = in.rice(rice);
    if (gap >= ranks || (rank += gap + 1) >= ranks) throw DecodeError("a point lies outside its cell");
    if (lattice.scattered()) {
      p = {detail_morton::gather(rank), detail_morton::gather(rank >> 1)};
      continue;
    }
    if (rank - row_start >= lattice.width) row = rank / lattice.width, row_start = row * lattice.width;
    p = {static_cast<std::uint32_t>(rank - row_start), static_cast<std::uint32_t>(row)};
  }
  return positions;
}

// Returns heights in steps from the first one, in the order of coding.
std::vector<std::int64_t> heights_of(std::span<const GridPoint> points, std::uint64_t step) {
  std::vector<std::int64_t> heights;
  heights.reserve(points.size());
  for (const GridPoint& p : points) {
    heights.push_back((std::int64_t{p.z} - points[0].z) / static_cast<std::int64_t>(step));
  }
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

std::vector<LocalPosition> local_positions(const Cell& cell, const Lattice& lattice,
                                           std::span<const GridPoint> points) {
  const GridBox box = cell.box();
  std::vector<LocalPosition> positions;
  positions.reserve(points.size());
  for (const GridPoint& p : points) {
    positions.push_back(
        {static_cast<std::uint32_t>((static_cast<std::uint64_t>(p.x - box.xmin) - lattice.x0) / lattice.step_x),
         static_cast<std::uint32_t>((static_cast<std::uint64_t>(p.y - box.ymin) - lattice.y0) / lattice.step_y)});
  }
  return positions;
}

std::uint64_t height_step(std::span<const GridPoint> points) {
  std::uint64_t step = 0;
  for (const GridPoint& p : points) {
    include(step, std::int64_t{p.z} - points[0].z);
  }
  return std::max<std::uint64_t>(step, 1);
}

void put_header(std::vector<std::uint8_t>& out, std::size_t count, const Lattice& lattice, std::uint64_t step_z) {
  put_varint(out, count);
  put_varint(out, lattice.step_x);
  put_varint(out, lattice.step_y);
  put_varint(out, step_z);
  if (lattice.scattered()) return;
  put_varint(out, lattice.x0);
  put_varint(out, lattice.y0);
  put_varint(out, lattice.width);
}

Lattice read_lattice(ByteReader& in, const Cell& cell) {
  const std::uint64_t side = std::uint64_t{1} << cell.log2_side;
  Lattice lattice;
  lattice.step_x = in.varint(1, side);
  lattice.step_y = in.varint(1, side);
  return lattice;
}

void read_lattice_origin(ByteReader& in, const Cell& cell, Lattice& lattice) {
  if (lattice.scattered()) return;
  const std::uint64_t last = (std::uint64_t{1} << cell.log2_side) - 1;
  lattice.x0 = static_cast<std::uint32_t>(in.varint(0, last));
  lattice.y0 = static_cast<std::uint32_t>(in.varint(0, last));
  lattice.width = in.varint(1, (last - lattice.x0) / lattice.step_x + 1);
}

std::int32_t checked_height(std::int64_t z) {
  if (z < std::numeric_limits<std::int32_t>::min() || z > std::numeric_limits<std::int32_t>::max()) {
    throw DecodeError("a height is out of range");
  }
  return static_cast<std::int32_t>(z);
}

// Returns the plan position of each local position, at height 0.
std::vector<GridPoint> plan_points(const Cell& cell, const Lattice& lattice, std::span<const LocalPosition> positions) {
  const GridBox box = cell.box();
  const auto last_row = ((std::uint64_t{1} << cell.log2_side) - 1 - lattice.y0) / lattice.step_y;
  if (positions.back().y > last_row && !lattice.scattered()) throw DecodeError("a point lies outside its cell");
  std::vector<GridPoint> points;
  points.reserve(positions.size());
  for (const LocalPosition& p : positions) {
    points.push_back({static_cast<std::int32_t>(box.xmin + lattice.x0 + p.x * lattice.step_x),
                      static_cast<std::int32_t>(box.ymin + lattice.y0 + p.y * lattice.step_y), 0});
  }
  return points;
}

}  // namespace

std::vector<std::uint8_t> encode_block(const Cell& cell, std::span<const GridPoint> points,
                                       std::span<const std::uint16_t> sources) {
  ITIN_PRECONDITION(!points.empty() && points.size() <= kMaxBlockPoints && sources.size() == points.size());
  ITIN_PRECONDITION(std::adjacent_find(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) {
                      return code_of(a) >= code_of(b);
                    }) == points.end());
  ITIN_PRECONDITION(cell.contains(code_of(points.front())) && cell.contains(code_of(points.back())));
  const Lattice lattice = find_lattice(cell, points);
  std::vector<GridPoint> ordered(points.begin(), points.end());
  if (!lattice.scattered()) sort_by_rows(cell, lattice, ordered);
  const std::uint64_t step_z = height_step(ordered);
  const std::vector<std::uint64_t> gaps = gaps_of(cell, lattice, ordered);
  const std::vector<std::int64_t> heights = heights_of(ordered, step_z);
  std::vector<std::uint64_t> residuals;
  residuals.reserve(heights.size());
  for_each_prediction(local_positions(cell, lattice, ordered), [&](std::size_t i, std::int64_t prediction) {
    residuals.push_back(zigzag(heights[i] - prediction));
    return heights[i];
  });
  const int gap_rice = best_block_parameter(gaps), first_rice = mean_parameter(residuals);

  std::vector<std::uint8_t> out;
  put_header(out, points.size(), lattice, step_z);
  put_varint(out, zigzag(ordered[0].z));
  out.push_back(static_cast<std::uint8_t>(gap_rice));
  out.push_back(static_cast<std::uint8_t>(first_rice));
  put_sources(out, sources);
  BitWriter bits(out);
  for (const std::uint64_t gap : gaps) bits.rice(gap, gap_rice);
  ResidualScale scale(first_rice);
  for (const std::uint64_t r : residuals) {
    bits.rice(r, scale.parameter());
    scale.add(r);
  }
  bits.finish();
  return out;
}

namespace {

// The beginning of a block.
struct Header {
  std::size_t count;
  Lattice lattice;
  std::uint64_t step_z;
  ByteReader rest;
};

Header read_header(const Cell& cell, std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const auto count = static_cast<std::size_t>(in.varint(1, kMaxBlockPoints));
  Lattice lattice = read_lattice(in, cell);
  const std::uint64_t step_z = in.varint(1, std::uint64_t{1} << 32);
  read_lattice_origin(in, cell, lattice);
  return {count, lattice, step_z, in};
}

// The parameters that a block is coded by, and the positions of its points.
struct Plan {
  Lattice lattice;
  std::uint64_t step_z;
  std::int64_t first_z;
  int first_rice;
  PointSources sources;
  std::vector<std::uint8_t> padded;
  std::vector<LocalPosition> positions;
  std::optional<BitReader> heights;  // reads `padded` from the first residual on
};

Plan read_plan(const Cell& cell, std::span<const std::uint8_t> bytes) {
  auto [count, lattice, step_z, header] = read_header(cell, bytes);
  Plan plan{lattice, step_z, 0, 0, {}, {}, {}, {}};
  plan.first_z = checked_height(header.signed_varint());
  const auto gap_rice = static_cast<int>(header.varint(0, kMaxRiceParameter));
  plan.first_rice = static_cast<int>(header.varint(0, kMaxRiceParameter));
  plan.sources = read_sources(header, count);
  plan.padded.reserve(header.rest().size() + BitReader::kPadding);
  plan.padded.assign(header.rest().begin(), header.rest().end());
  plan.padded.resize(plan.padded.size() + BitReader::kPadding);
  BitReader bits(plan.padded);
  plan.positions = read_positions(bits, count, gap_rice, cell, plan.lattice);
  plan.heights = bits;
  return plan;
}

}  // namespace

BlockLattice decode_lattice(const Cell& cell, std::span<const std::uint8_t> bytes) {
  const GridBox box = cell.box();
  const Header header = read_header(cell, bytes);
  const Lattice& lattice = header.lattice;
  return {static_cast<std::uint32_t>(header.count), static_cast<std::int32_t>(box.xmin + lattice.x0),
          static_cast<std::int32_t>(box.ymin + lattice.y0), static_cast<std::int64_t>(lattice.step_x),
          static_cast<std::int64_t>(lattice.step_y)};
}

Block decode_plan(const Cell& cell, std::span<const std::uint8_t> bytes) {
  const Plan plan = read_plan(cell, bytes);
  Block block;
  block.points = plan_points(cell, plan.lattice, plan.positions);
  block.in_order = plan.lattice.scattered();
  return block;
}

Block decode_block(const Cell& cell, std::span<const std::uint8_t> bytes, BlockOrder order) {
  Plan plan = read_plan(cell, bytes);
  BitReader bits = *plan.heights;
  Block block;
  block.sources = std::move(plan.sources);
  block.points = plan_points(cell, plan.lattice, plan.positions);
  block.points[0].z = static_cast<std::int32_t>(plan.first_z);
  const std::int64_t most_steps = (std::int64_t{1} << 32) / static_cast<std::int64_t>(plan.step_z);
  ResidualScale scale(plan.first_rice);
  for_each_prediction(std::move(plan.positions), [&](std::size_t i, std::int64_t prediction) {
    const std::uint64_t residual = bits.rice(scale.parameter());
    scale.add(residual);
    // Only heights whose product with the step is a 32-bit difference may be multiplied.
    const auto height = static_cast<std::int64_t>(static_cast<std::uint64_t>(prediction) +
                                                  static_cast<std::uint64_t>(unzigzag(residual)));
    if (height < -most_steps || height > most_steps) throw DecodeError("a height is out of range");
    block.points[i].z = checked_height(plan.first_z + height * static_cast<std::int64_t>(plan.step_z));
    return height;
  });
  if (!bits.finished_cleanly()) throw DecodeError("points end too early or too late");
  block.in_order = plan.lattice.scattered();
  if (!block.in_order && order == BlockOrder::kMorton) {
    sort_along_curve(cell, plan.lattice.step_x, plan.lattice.step_y, block.points);
    block.in_order = true;
  }
  return block;
}

}  // namespace itin
