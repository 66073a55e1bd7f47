#include "store/segments/edge_quadtree.hpp"

#include <algorithm>

#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

#include "store/codec/byte_stream.hpp"
#include "store/codec/zstd_frame.hpp"

namespace itin {

namespace {

using Visit = std::function<bool(const Cell&, const std::vector<Segment>&)>;

/// Visits the leaves of the cell; returns whether to go on.
bool split(const Cell& cell, const std::vector<Segment>& segments, const Visit& visit) {
  if (segments.empty()) return true;
  if (segments.size() <= kEdgeLeafCapacity || cell.log2_side <= kMinEdgeLeafLog2Side) return visit(cell, segments);
  bool go_on = true;
  for (int i = 0; i < 4 && go_on; ++i) {
    const Cell child = cell.child(i);
    std::vector<Segment> part;
    std::copy_if(segments.begin(), segments.end(), std::back_inserter(part),
                 [&](const Segment& s) { return crosses(s, child); });
    go_on = split(child, part, visit);
  }
  return go_on;
}

std::int32_t checked_coordinate(std::int64_t v) {
  if (v < -kGridHalfSide || v >= kGridHalfSide) throw DecodeError("a segment leaves the grid");
  return static_cast<std::int32_t>(v);
}

}  // namespace

bool crosses(const Segment& s, const Cell& cell) {
  const std::int64_t side = std::int64_t{1} << cell.log2_side;
  const std::int64_t x0 = morton_x(cell.code), y0 = morton_y(cell.code), x1 = x0 + side, y1 = y0 + side;
  if (std::max(s.ax, s.bx) < x0 || std::min(s.ax, s.bx) > x1) return false;
  if (std::max(s.ay, s.by) < y0 || std::min(s.ay, s.by) > y1) return false;
  // The line misses the box when all four corners lie strictly to one side. Differences stay below 2^31, so that the
  // difference of two products fits.
  const std::int64_t dx = std::int64_t{s.bx} - s.ax, dy = std::int64_t{s.by} - s.ay;
  const auto side_of = [&](std::int64_t x, std::int64_t y) { return dx * (y - s.ay) - dy * (x - s.ax); };
  const auto [low, high] = std::minmax({side_of(x0, y0), side_of(x1, y0), side_of(x0, y1), side_of(x1, y1)});
  return low <= 0 && high >= 0;
}

void for_each_edge_leaf(std::vector<Segment> segments,
                        const std::function<void(const Cell&, const std::vector<Segment>&)>& visit) {
  visit_edge_leaves(std::move(segments), [&](const Cell& cell, const std::vector<Segment>& near) {
    visit(cell, near);
    return true;
  });
}

void visit_edge_leaves(std::vector<Segment> segments, const Visit& visit) {
  sort_unique(segments);
  split(Cell{}, segments, visit);
}

std::vector<std::uint8_t> encode_outline(const Cell& cell, const std::vector<Segment>& segments) {
  ITIN_PRECONDITION(std::is_sorted(segments.begin(), segments.end()));
  std::vector<std::uint8_t> out;
  std::int64_t x = morton_x(cell.code), y = morton_y(cell.code);
  for (const Segment& s : segments) {
    put_varint(out, zigzag(s.ax - x));
    put_varint(out, zigzag(s.ay - y));
    put_varint(out, zigzag(std::int64_t{s.bx} - s.ax));
    put_varint(out, zigzag(std::int64_t{s.by} - s.ay));
    x = s.ax, y = s.ay;
  }
  return compress(out);
}

std::vector<Segment> decode_outline(const Cell& cell, std::size_t count, std::span<const std::uint8_t> bytes) {
  constexpr std::size_t most_bytes_per_segment = 4 * 9;
  const std::vector<std::uint8_t> content = decompress(bytes, count * most_bytes_per_segment);
  ByteReader in(content);
  std::vector<Segment> segments;
  std::int64_t x = morton_x(cell.code), y = morton_y(cell.code);
  while (!in.rest().empty()) {
    Segment s;
    s.ax = checked_coordinate(x + in.signed_varint());
    s.ay = checked_coordinate(y + in.signed_varint());
    s.bx = checked_coordinate(s.ax + in.signed_varint());
    s.by = checked_coordinate(s.ay + in.signed_varint());
    if (!crosses(s, cell)) throw DecodeError("a segment lies outside its cell");
    if (!segments.empty() && segments.back() >= s) throw DecodeError("segments are out of order");
    segments.push_back(s);
    x = s.ax, y = s.ay;
  }
  if (segments.size() != count) throw DecodeError("has the wrong number of segments");
  return segments;
}

}  // namespace itin
