#include "store/segments/line_codec.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

#include "store/codec/bit_stream.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/rice_parameter.hpp"
#include "store/segments/edge_quadtree.hpp"

namespace itin {

namespace {

struct Vertex {
  std::int64_t x, y;
  friend auto operator<=>(const Vertex&, const Vertex&) = default;
};

/// The fields that are written as Rice codes, each with a parameter of its own.
enum Field { kGap, kDegree, kOther, kFinest, kCoarsest, kReach, kFields };

/// The lattice that all ends lie on.
struct LineLattice {
  Vertex corner;
  Vertex step;
  int row_bits;  ///< number of bits of the greatest row
};

std::vector<Vertex> ends_of(const std::vector<Segment>& segments) {
  std::vector<Vertex> ends;
  for (const Segment& s : segments) {
    ends.push_back({s.ax, s.ay});
    ends.push_back({s.bx, s.by});
  }
  sort_unique(ends);
  return ends;
}

LineLattice lattice_of(const std::vector<Vertex>& ends) {
  LineLattice lattice{{ends.front().x, ends.front().y}, {0, 0}, 0};
  std::int64_t highest = ends.front().y;
  for (const Vertex& v : ends) {
    lattice.corner.y = std::min(lattice.corner.y, v.y);
    highest = std::max(highest, v.y);
  }
  for (const Vertex& v : ends) {
    lattice.step.x = std::gcd(lattice.step.x, v.x - lattice.corner.x);
    lattice.step.y = std::gcd(lattice.step.y, v.y - lattice.corner.y);
  }
  lattice.step = {std::max<std::int64_t>(1, lattice.step.x), std::max<std::int64_t>(1, lattice.step.y)};
  lattice.row_bits = std::bit_width(static_cast<std::uint64_t>((highest - lattice.corner.y) / lattice.step.y));
  return lattice;
}

/// Tells whether all segments go from left to right, as most lines do; they then need no sign.
bool are_ascending(const std::vector<Segment>& segments) {
  return std::all_of(segments.begin(), segments.end(), [](const Segment& s) {
    return Vertex{s.ax, s.ay} < Vertex{s.bx, s.by};
  });
}

/// All values that are written as Rice codes, field by field, in the order of writing.
class LinePlan {
 public:
  LinePlan(const std::vector<Segment>& segments, const std::vector<Vertex>& ends, const LineLattice& lattice,
           bool forwards) {
    std::int64_t x = lattice.corner.x;
    for (const Vertex& v : ends) {
      values_[kGap].push_back(static_cast<std::uint64_t>((v.x - x) / lattice.step.x));
      x = v.x;
    }
    const auto number = [&](std::int64_t vx, std::int64_t vy) {
      return std::lower_bound(ends.begin(), ends.end(), Vertex{vx, vy}) - ends.begin();
    };
    values_[kDegree].assign(ends.size(), 0);
    for (const Segment& s : segments) {
      const auto a = number(s.ax, s.ay), b = number(s.bx, s.by);
      values_[kDegree][static_cast<std::size_t>(a)] += 1;
      values_[kOther].push_back(forwards ? static_cast<std::uint64_t>(b - a - 1) : zigzag(b - a));
      values_[kFinest].push_back(s.finest);
      values_[kCoarsest].push_back(s.coarsest == 0xff ? 0u : s.coarsest - s.finest + 1u);
      // A segment of the finest level stands for itself alone, and has no reach.
      if (s.finest > 0) values_[kReach].push_back(static_cast<std::uint64_t>(s.reach));
    }
    for (std::size_t f = 0; f < kFields; ++f) parameters_[f] = best_rice_parameter(values_[f]);
  }

  int parameter(Field f) const { return parameters_[f]; }
  std::uint64_t value(Field f, std::size_t i) const { return values_[f][i]; }

 private:
  std::array<std::vector<std::uint64_t>, kFields> values_;
  std::array<int, kFields> parameters_{};
};

std::int32_t checked(std::int64_t v) {
  if (v < -kGridHalfSide || v >= kGridHalfSide) throw DecodeError("a segment leaves the grid");
  return static_cast<std::int32_t>(v);
}

class LineReader {
 public:
  LineReader(const Cell& cell, std::uint16_t theme, std::size_t count, std::span<const std::uint8_t> bytes)
      : cell_(cell), theme_(theme), count_(count) {
    ByteReader header(bytes);
    vertices_ = header.varint(2, 2 * std::uint64_t{count});
    forwards_ = header.varint(0, 1) == 1;
    lattice_.corner.x = checked(morton_x(cell.code) + header.signed_varint());
    lattice_.corner.y = checked(morton_y(cell.code) + header.signed_varint());
    constexpr std::uint64_t most = 2 * static_cast<std::uint64_t>(kGridHalfSide);
    lattice_.step = {static_cast<std::int64_t>(header.varint(1, most)),
                     static_cast<std::int64_t>(header.varint(1, most))};
    lattice_.row_bits = static_cast<int>(header.varint(0, 30));
    for (int& k : parameters_) k = static_cast<int>(header.varint(0, kMaxRiceParameter));
    padded_.assign(header.rest().begin(), header.rest().end());
    padded_.resize(padded_.size() + BitReader::kPadding);
  }

  std::vector<Segment> read() {
    BitReader bits(padded_);
    read_vertices(bits);
    std::vector<Segment> segments;
    for (std::size_t a = 0; a < vertices_; ++a) {
      const std::uint64_t degree = bits.rice(parameters_[kDegree]);
      if (degree > count_ - segments.size()) throw DecodeError("has the wrong number of segments");
      for (std::uint64_t i = 0; i < degree; ++i) {
        const Segment s = read_segment(bits, a);
        if (!crosses(s, cell_)) throw DecodeError("a segment lies outside its cell");
        if (!segments.empty() && segments.back() >= s) throw DecodeError("segments are out of order");
        segments.push_back(s);
      }
    }
    if (segments.size() != count_) throw DecodeError("has the wrong number of segments");
    if (!bits.finished_cleanly()) throw DecodeError("segments end too early or too late");
    return segments;
  }

 private:
  void read_vertices(BitReader& bits) {
    Vertex before{lattice_.corner.x, lattice_.corner.y - 1};
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      const std::uint64_t columns = bits.rice(parameters_[kGap]), row = bits.bits(lattice_.row_bits);
      if (columns > 2 * static_cast<std::uint64_t>(kGridHalfSide)) throw DecodeError("a segment leaves the grid");
      const Vertex v{checked(before.x + static_cast<std::int64_t>(columns) * lattice_.step.x),
                     checked(lattice_.corner.y + static_cast<std::int64_t>(row) * lattice_.step.y)};
      if (v <= before) throw DecodeError("ends of segments are out of order");
      ends_.push_back(v);
      before = v;
    }
  }

  Segment read_segment(BitReader& bits, std::size_t a) const {
    const std::uint64_t other = bits.rice(parameters_[kOther]);
    const std::uint64_t b = forwards_ ? a + 1 + other : a + static_cast<std::uint64_t>(unzigzag(other));
    if (b >= ends_.size() || b == a) throw DecodeError("a segment has no end");
    Segment s;
    s.ax = static_cast<std::int32_t>(ends_[a].x), s.ay = static_cast<std::int32_t>(ends_[a].y);
    s.bx = static_cast<std::int32_t>(ends_[b].x), s.by = static_cast<std::int32_t>(ends_[b].y);
    s.theme = theme_;
    const std::uint64_t finest = bits.rice(parameters_[kFinest]), span = bits.rice(parameters_[kCoarsest]);
    if (finest > 0xff || span > 0xff || (span > 0 && finest + span - 1 > 0xff))
      throw DecodeError("a level is out of range");
    s.finest = static_cast<std::uint8_t>(finest);
    s.coarsest = static_cast<std::uint8_t>(span == 0 ? 0xff : finest + span - 1);
    if (finest == 0) return s;
    const std::uint64_t reach = bits.rice(parameters_[kReach]);
    if (reach > 2 * static_cast<std::uint64_t>(kGridHalfSide) - 1) throw DecodeError("an integer is out of range");
    s.reach = static_cast<std::int32_t>(reach);
    return s;
  }

  Cell cell_;
  std::uint16_t theme_;
  std::size_t count_;
  std::uint64_t vertices_ = 0;
  bool forwards_ = false;
  LineLattice lattice_{};
  std::array<int, kFields> parameters_{};
  std::vector<std::uint8_t> padded_;
  std::vector<Vertex> ends_;
};

}  // namespace

std::vector<std::uint8_t> encode_lines(const Cell& cell, const std::vector<Segment>& segments) {
  ITIN_PRECONDITION(!segments.empty() && std::is_sorted(segments.begin(), segments.end()));
  ITIN_PRECONDITION(std::all_of(segments.begin(), segments.end(),
                                [&](const Segment& s) { return s.theme == segments.front().theme; }));
  const std::vector<Vertex> ends = ends_of(segments);
  const LineLattice lattice = lattice_of(ends);
  const bool forwards = are_ascending(segments);
  const LinePlan plan(segments, ends, lattice, forwards);
  std::vector<std::uint8_t> out;
  put_varint(out, ends.size());
  put_varint(out, forwards ? 1 : 0);
  put_varint(out, zigzag(lattice.corner.x - morton_x(cell.code)));
  put_varint(out, zigzag(lattice.corner.y - morton_y(cell.code)));
  put_varint(out, static_cast<std::uint64_t>(lattice.step.x));
  put_varint(out, static_cast<std::uint64_t>(lattice.step.y));
  put_varint(out, static_cast<std::uint64_t>(lattice.row_bits));
  for (int f = 0; f < kFields; ++f) put_varint(out, static_cast<std::uint64_t>(plan.parameter(static_cast<Field>(f))));

  BitWriter bits(out);
  const auto write = [&](Field f, std::size_t i) { bits.rice(plan.value(f, i), plan.parameter(f)); };
  for (std::size_t v = 0; v < ends.size(); ++v) {
    write(kGap, v);
    bits.bits(static_cast<std::uint64_t>((ends[v].y - lattice.corner.y) / lattice.step.y), lattice.row_bits);
  }
  std::size_t segment = 0, reached = 0;
  for (std::size_t v = 0; v < ends.size(); ++v) {
    write(kDegree, v);
    for (std::uint64_t i = 0; i < plan.value(kDegree, v); ++i, ++segment) {
      for (const Field f : {kOther, kFinest, kCoarsest}) write(f, segment);
      if (segments[segment].finest > 0) write(kReach, reached++);
    }
  }
  bits.finish();
  return out;
}

std::vector<Segment> decode_lines(const Cell& cell, std::uint16_t theme, std::size_t count,
                                  std::span<const std::uint8_t> bytes) {
  return LineReader(cell, theme, count, bytes).read();
}

}  // namespace itin
