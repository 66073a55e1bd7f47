#include "store/set_aside.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "store/codec/block_codec.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/store_format.hpp"
#include "store/codec/zstd_frame.hpp"

namespace itin {

namespace {

constexpr std::size_t kMostSetAsideBytes = std::size_t{1} << 24;
constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();

/// Writes numbers as differences from earlier ones.
class Differences {
 public:
  void put(std::int64_t v, std::int64_t from) { put_varint(bytes_, zigzag(v - from)); }
  void count(std::size_t n) { put_varint(bytes_, n); }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

template <class Whole>
Whole whole(ByteReader& in, std::int64_t from) {
  const std::int64_t v = in.signed_varint() + from;
  if (v < std::numeric_limits<Whole>::min() || v > std::numeric_limits<Whole>::max())
    throw DecodeError("an integer is out of range");
  return static_cast<Whole>(v);
}

std::int32_t coordinate(ByteReader& in, std::int64_t from) {
  const auto v = whole<std::int32_t>(in, from);
  if (v < -kGridHalfSide || v >= kGridHalfSide) throw DecodeError("a position is outside of the grid");
  return v;
}

std::size_t count(ByteReader& in) {
  return static_cast<std::size_t>(in.varint(0, kSetAsideInBlock));
}

ImportedSegment imported_after(const ImportedSegment& last, ByteReader& in) {
  ImportedSegment s;
  s.a.x = coordinate(in, last.a.x);
  s.a.y = coordinate(in, last.a.y);
  s.b.x = coordinate(in, s.a.x);
  s.b.y = coordinate(in, s.a.y);
  s.a.z = whole<std::int32_t>(in, last.a.z);
  s.b.z = whole<std::int32_t>(in, s.a.z);
  s.source = whole<std::uint16_t>(in, last.source);
  return s;
}

/// Returns 0 for no feature. A block whose segments have no features ends before these numbers.
std::uint32_t numbered(std::uint32_t feature) {
  return feature + 1;
}

void read_features(ByteReader& in, std::vector<ImportedSegment>& imported) {
  std::uint32_t before = 0;
  for (ImportedSegment& s : imported) {
    before = whole<std::uint32_t>(in, before);
    s.feature = before - 1;
  }
}

Segment made_after(const Segment& last, ByteReader& in) {
  Segment s;
  s.ax = coordinate(in, last.ax);
  s.ay = coordinate(in, last.ay);
  s.bx = coordinate(in, s.ax);
  s.by = coordinate(in, s.ay);
  return s;
}

SetAsideLines decode_set_aside_lines(std::span<const std::uint8_t> bytes) {
  const std::vector<std::uint8_t> content = decompress(bytes, kMostSetAsideBytes);
  ByteReader in(content);
  SetAsideLines lines;
  for (std::size_t n = count(in); n > 0; --n) {
    const bool first = lines.imported.empty();
    lines.imported.push_back(imported_after(first ? ImportedSegment{} : lines.imported.back(), in));
  }
  Segment last;
  for (std::size_t n = count(in); n > 0; --n) lines.made.push_back(last = made_after(last, in));
  if (!in.rest().empty()) read_features(in, lines.imported);
  if (!in.rest().empty()) throw DecodeError("has too many bytes");
  const auto disordered = std::adjacent_find(lines.imported.begin(), lines.imported.end(), std::greater_equal<>());
  if (disordered != lines.imported.end()) throw DecodeError("lines are not in order");
  return lines;
}

Block decode_set_aside_points(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  Cell cell;
  cell.log2_side = static_cast<int>(in.varint(0, kRootLog2Side));
  cell.code = in.varint(0, (std::uint64_t{1} << (2 * kRootLog2Side)) - 1);
  if ((cell.code & ((std::uint64_t{1} << (2 * cell.log2_side)) - 1)) != 0) throw DecodeError("is of no cell");
  return decode_block(cell, in.rest());
}

SetAsideList decode_set_aside_list(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  SetAsideList list;
  list.point_blocks = static_cast<std::uint32_t>(in.varint(0, kMost));
  list.line_blocks.resize(in.varint(0, format::kMaxThemes));
  for (std::uint32_t& blocks : list.line_blocks) blocks = static_cast<std::uint32_t>(in.varint(0, kMost));
  SetAsideCounts& counts = list.counts;
  for (std::uint64_t* number : {&counts.replaced, &counts.isolated, &counts.segments, &counts.crossings})
    *number = in.varint();
  if (!in.rest().empty()) throw DecodeError("has too many bytes");
  return list;
}

}  // namespace

std::vector<std::uint8_t> encode_set_aside(const Cell& cell, std::span<const GridPoint> points,
                                           std::span<const std::uint16_t> sources) {
  std::vector<std::uint8_t> bytes;
  put_varint(bytes, static_cast<std::uint64_t>(cell.log2_side));
  put_varint(bytes, cell.code);
  const std::vector<std::uint8_t> block = encode_block(cell, points, sources);
  bytes.insert(bytes.end(), block.begin(), block.end());
  return bytes;
}

std::vector<std::uint8_t> encode_set_aside(std::span<const ImportedSegment> imported, std::span<const Segment> made) {
  Differences out;
  out.count(imported.size());
  ImportedSegment last;
  for (const ImportedSegment& s : imported) {
    out.put(s.a.x, last.a.x), out.put(s.a.y, last.a.y);
    out.put(s.b.x, s.a.x), out.put(s.b.y, s.a.y);
    out.put(s.a.z, last.a.z), out.put(s.b.z, s.a.z);
    out.put(s.source, last.source);
    last = s;
  }
  out.count(made.size());
  Segment before;
  for (const Segment& s : made) {
    out.put(s.ax, before.ax), out.put(s.ay, before.ay);
    out.put(s.bx, s.ax), out.put(s.by, s.ay);
    before = s;
  }
  const auto known = [](const ImportedSegment& s) { return s.feature != kNoFeature; };
  if (std::any_of(imported.begin(), imported.end(), known)) {
    std::uint32_t feature = 0;
    for (const ImportedSegment& s : imported) out.put(numbered(s.feature), std::exchange(feature, numbered(s.feature)));
  }
  return compress(out.bytes());
}

std::vector<std::uint8_t> encode_set_aside(const SetAsideList& list) {
  std::vector<std::uint8_t> bytes;
  put_varint(bytes, list.point_blocks);
  put_varint(bytes, list.line_blocks.size());
  for (const std::uint32_t blocks : list.line_blocks) put_varint(bytes, blocks);
  const SetAsideCounts& counts = list.counts;
  for (const std::uint64_t number : {counts.replaced, counts.isolated, counts.segments, counts.crossings})
    put_varint(bytes, number);
  return bytes;
}

SetAsideList set_aside_list(const StoreRows& rows) {
  return decoded(rows, BlobKind::Directory, format::kSetAsideListKey, decode_set_aside_list);
}

Block set_aside_points(const StoreRows& rows, std::uint32_t block) {
  return decoded(rows, BlobKind::Block, format::set_aside_key(0, block), decode_set_aside_points);
}

SetAsideLines set_aside_lines(const StoreRows& rows, std::uint16_t theme, std::uint32_t block) {
  return decoded(rows, BlobKind::Block, format::set_aside_key(theme, block), decode_set_aside_lines);
}

}  // namespace itin
